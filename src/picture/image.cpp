#include "picture/image.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace windfall::picture {
namespace {

/// Uchimura, "HDR theory and practice" (2017): toe, straight middle of slope 1, shoulder to 1.
float filmic(float x) {
    constexpr float kPeak = 1.0F, kContrast = 1.05F, kStart = 0.22F, kLength = 0.4F, kToe = 1.25F;
    constexpr float l0 = (kPeak - kStart) * kLength / kContrast;
    constexpr float s0 = kStart + l0;
    constexpr float s1 = kStart + kContrast * l0;
    constexpr float c2 = kContrast * kPeak / (kPeak - s1);
    const float t = std::clamp(x / kStart, 0.0F, 1.0F);
    const float toe_weight = 1 - t * t * (3 - 2 * t);
    const float shoulder_weight = x < s0 ? 0.0F : 1.0F;
    const float toe = kStart * std::pow(std::max(x, 0.0F) / kStart, kToe);
    const float line = kStart + kContrast * (x - kStart);
    const float shoulder = kPeak - (kPeak - s1) * std::exp(-c2 * (x - s0) / kPeak);
    return toe * toe_weight + line * (1 - toe_weight - shoulder_weight) + shoulder * shoulder_weight;
}

/// Triangular noise in (-1, 1) from the place of a pixel and its channel.
float dither(std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
    std::uint32_t h = x * 0x9E3779B9U ^ y * 0x85EBCA6BU ^ channel * 0xC2B2AE35U;
    h ^= h >> 16U;
    h *= 0x7FEB352DU;
    h ^= h >> 15U;
    h *= 0x846CA68BU;
    h ^= h >> 16U;
    return static_cast<float>(h & 0xFFFFU) / 65536.0F - static_cast<float>(h >> 16U) / 65536.0F;
}

}  // namespace

Image8::Image8(int w, int h, std::array<std::uint8_t, 3> fill) : width(w), height(h) {
    bytes.resize(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = fill[i % 3];
}

float srgb_from_linear(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

float linear_from_srgb(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

Image8 to_srgb8(const Image& image, ToneCurve curve) {
    Image8 result(image.width, image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto& pixel = image.at(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                const float shown = curve == ToneCurve::Filmic ? filmic(pixel[c]) : pixel[c];
                const float value = 255 * srgb_from_linear(std::clamp(shown, 0.0F, 1.0F));
                const float noise =
                    value > 0.5F && value < 254.5F
                        ? 0.5F * dither(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                        static_cast<std::uint32_t>(c))
                        : 0.0F;
                result.bytes[3 * image.index(x, y) + c] =
                    static_cast<std::uint8_t>(std::clamp(value + noise + 0.5F, 0.0F, 255.0F));
            }
        }
    return result;
}

void paste(Image8& target, const Image8& source, int x, int y) {
    const int left = std::max(0, -x), right = std::min(source.width, target.width - x);
    if (left >= right) return;
    for (int row = std::max(0, -y); row < std::min(source.height, target.height - y); ++row) {
        const auto from = static_cast<std::size_t>(row) * static_cast<std::size_t>(source.width) +
                          static_cast<std::size_t>(left);
        const auto to = static_cast<std::size_t>(row + y) * static_cast<std::size_t>(target.width) +
                        static_cast<std::size_t>(left + x);
        std::memcpy(target.bytes.data() + 3 * to, source.bytes.data() + 3 * from,
                    3 * static_cast<std::size_t>(right - left));
    }
}

}  // namespace windfall::picture
