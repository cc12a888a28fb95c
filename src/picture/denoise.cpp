// A-trous wavelet filter: Dammertz et al., "Edge-avoiding a-trous wavelet transform for fast global
// illumination filtering" (2010), doi:10.2312/EGGH/HPG10/067-075, steered by the variance as in Schied et
// al., "Spatiotemporal variance-guided filtering" (2017), doi:10.1145/3105762.3105770. The light is filtered,
// not the colour of the surface.
#include "picture/denoise.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace windfall::picture {
namespace {

constexpr int kLevels = 4;
// In standard deviations of the grain: larger smooths more and begins to eat highlights.
constexpr float kLightTolerance = 2.0F;
constexpr float kNormalTolerance_sq = 0.15F * 0.15F;
constexpr float kAlbedoTolerance_sq = 0.06F * 0.06F;
constexpr std::array<float, 3> kSpline{0.375F, 0.25F, 0.0625F};

struct Pixel {
    Vec3f light, albedo, normal;
    float variance = 0;  // of the luminance of the light
};

std::vector<Pixel> pixels_of(const std::vector<PixelSums>& sums, int samples) {
    const auto n = static_cast<float>(samples);
    std::vector<Pixel> pixels(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        Pixel& p = pixels[i];
        p.albedo = (sums[i].albedo / n).cwiseMax(0.02F);
        p.normal = sums[i].normal / n;
        p.light = (sums[i].radiance / n).cwiseQuotient(p.albedo);
        const float mean = sums[i].luminance / n;
        const float spread = std::max(0.0F, sums[i].luminance_sq / n - mean * mean);
        const float scale = luminance(p.albedo);
        p.variance = spread / std::max(1.0F, n - 1) / (scale * scale);
    }
    return pixels;
}

/// The variance of a pixel is itself noisy; its neighbours know it too.
float smooth_variance(const std::vector<Pixel>& pixels, int width, int height, int x, int y) {
    float sum = 0, weight = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= width || v >= height) continue;
            const float w = (dx == 0 ? 2.0F : 1.0F) * (dy == 0 ? 2.0F : 1.0F);
            sum += w * pixels[static_cast<std::size_t>(v * width + u)].variance;
            weight += w;
        }
    return sum / weight;
}

Pixel filtered(const std::vector<Pixel>& pixels, int width, int height, int x, int y, int step) {
    const Pixel& centre = pixels[static_cast<std::size_t>(y * width + x)];
    const float here = luminance(centre.light);
    const float tolerance = kLightTolerance * std::sqrt(smooth_variance(pixels, width, height, x, y)) + 1e-4F;
    Vec3f light = Vec3f::Zero();
    float variance = 0, total = 0;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            const int u = x + i * step, v = y + j * step;
            if (u < 0 || v < 0 || u >= width || v >= height) continue;
            const Pixel& other = pixels[static_cast<std::size_t>(v * width + u)];
            const float distance = (other.normal - centre.normal).squaredNorm() / kNormalTolerance_sq +
                                   (other.albedo - centre.albedo).squaredNorm() / kAlbedoTolerance_sq +
                                   std::abs(luminance(other.light) - here) / tolerance;
            const float w = kSpline[static_cast<std::size_t>(std::abs(i))] *
                            kSpline[static_cast<std::size_t>(std::abs(j))] * std::exp(-distance);
            light += w * other.light;
            variance += w * w * other.variance;
            total += w;
        }
    Pixel result = centre;
    result.light = light / total;
    result.variance = variance / (total * total);
    return result;
}

}  // namespace

Image mean_image(int width, int height, const std::vector<PixelSums>& sums, int samples) {
    Image image(width, height);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Vec3f mean = sums[i].radiance / static_cast<float>(samples);
        image.pixels[i] = {mean.x(), mean.y(), mean.z()};
    }
    return image;
}

Image denoised_image(int width, int height, const std::vector<PixelSums>& sums, int samples) {
    std::vector<Pixel> pixels = pixels_of(sums, samples), next = pixels;
    for (int level = 0; level < kLevels; ++level) {
        parallel_for_each(static_cast<std::size_t>(height), [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < width; ++x)
                next[static_cast<std::size_t>(y * width + x)] =
                    filtered(pixels, width, height, x, y, 1 << level);
        });
        pixels.swap(next);
    }
    Image image(width, height);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Vec3f colour = pixels[i].light.cwiseProduct(pixels[i].albedo);
        image.pixels[i] = {colour.x(), colour.y(), colour.z()};
    }
    return image;
}

}  // namespace windfall::picture
