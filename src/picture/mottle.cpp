// Gradient noise: Perlin, "Improving noise" (2002), doi:10.1145/566654.566636; gradients by counter.
#include "picture/mottle.h"

#include <cmath>

#include "core/random.h"

namespace windfall::picture {
namespace {

Vec3f gradient(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    constexpr std::uint64_t kMask = (1U << 21U) - 1;  // three coordinates in one counter
    const std::uint64_t index = (static_cast<std::uint64_t>(x) & kMask) |
                                (static_cast<std::uint64_t>(y) & kMask) << 21U |
                                (static_cast<std::uint64_t>(z) & kMask) << 42U;
    const auto u = random_uniform4(seed, RandomPurpose::PictureMottle, index);
    const Vec3f g(static_cast<float>(2 * u[0] - 1), static_cast<float>(2 * u[1] - 1),
                  static_cast<float>(2 * u[2] - 1));
    return g / std::max(g.norm(), 1e-3F);
}

float fade(float t) { return t * t * t * (t * (6 * t - 15) + 10); }

}  // namespace

float smooth_noise(const Vec3f& place, std::uint64_t seed) {
    const Vec3f floor = place.array().floor();
    const Vec3f f = place - floor;
    const auto x = static_cast<std::int64_t>(floor.x()), y = static_cast<std::int64_t>(floor.y()),
               z = static_cast<std::int64_t>(floor.z());
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        const Vec3f from = f - Vec3f(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
        const float weight = (i ? fade(f.x()) : 1 - fade(f.x())) * (j ? fade(f.y()) : 1 - fade(f.y())) *
                             (k ? fade(f.z()) : 1 - fade(f.z()));
        sum += weight * gradient(x + i, y + j, z + k, seed).dot(from);
    }
    return 1.4F * sum;
}

float mottle_noise(const Vec3f& place, std::uint64_t seed) {
    return (smooth_noise(place, seed) + 0.5F * smooth_noise(2.03F * place, seed + 1) +
            0.25F * smooth_noise(4.1F * place, seed + 2)) /
           1.5F;
}

}  // namespace windfall::picture
