#pragma once
// Pictures in memory.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace windfall::picture {

/// Linear RGB, rows from the top.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::array<float, 3>> pixels;

    Image() = default;
    Image(int w, int h, std::array<float, 3> fill = {0, 0, 0})
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
    std::array<float, 3>& at(int x, int y) { return pixels[index(x, y)]; }
    const std::array<float, 3>& at(int x, int y) const { return pixels[index(x, y)]; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

/// sRGB, 8 bits a channel, 3 channels, rows from the top.
struct Image8 {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> bytes;

    Image8() = default;
    Image8(int w, int h, std::array<std::uint8_t, 3> fill = {255, 255, 255});
};

/// From linear light to the sRGB curve and back, for values in [0, 1].
float srgb_from_linear(float linear);
float linear_from_srgb(float srgb);

/// How linear light becomes a displayed value.
enum class ToneCurve {
    Filmic,  ///< straight in the middle, a toe and a shoulder: for materials
    Plain,   ///< as it is, cut at 1: for false colours, which must stay what they are
};

/// To 8 bits, with a dither of less than one step (from the pixel's place), which keeps soft backgrounds from
/// banding.
Image8 to_srgb8(const Image& image, ToneCurve curve);

/// Copies `source` into `target` with its top left corner at (x, y); what would lie outside is left out.
void paste(Image8& target, const Image8& source, int x, int y);

/// The bytes of a PNG file. Throws RunError when libspng fails.
std::vector<std::byte> encode_png(const Image8& image);

/// The picture in the bytes of a PNG file (alpha is dropped). Throws InputError when they are no PNG.
Image8 decode_png(std::span<const std::byte> bytes);

}  // namespace windfall::picture
