#pragma once
// Noise in space with its gradient, fast enough to be asked for at every camera ray. Deterministic: hashes of
// the place alone.
#include <cmath>
#include <cstdint>

#include "picture/scene.h"

namespace windfall::picture {

struct NoiseValue {
    float value = 0;
    Vec3f gradient = Vec3f::Zero();
};

/// 32 bits to 32 well mixed ones (Wellons' "lowbias32").
inline std::uint32_t hashed(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7FEB352DU;
    x ^= x >> 15U;
    x *= 0x846CA68BU;
    return x ^ x >> 16U;
}

inline std::uint32_t hashed_cell(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    return hashed(hashed(hashed(static_cast<std::uint32_t>(x) * 0x85EBCA6BU + seed) +
                         static_cast<std::uint32_t>(y) * 0xC2B2AE35U) +
                  static_cast<std::uint32_t>(z) * 0x27D4EB2FU);
}

/// Gradient noise (Perlin 2002, doi:10.1145/566654.566636), about -1 .. 1, zero at whole coordinates. The
/// derivative is that of the interpolation, in closed form. |coordinates| < 2^30.
inline NoiseValue solid_noise(const Vec3f& place, std::uint32_t seed) {
    std::int32_t cell[3];
    float f[3], fade[3], slope[3];
    for (int k = 0; k < 3; ++k) {
        const float whole = std::floor(place[k]);
        cell[k] = static_cast<std::int32_t>(whole);
        const float t = f[k] = place[k] - whole;
        fade[k] = t * t * t * (t * (6 * t - 15) + 10);
        slope[k] = 30 * t * t * (t * (t - 2) + 1);
    }
    NoiseValue sum;
    for (int corner = 0; corner < 8; ++corner) {
        const int on[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        const std::uint32_t bits = hashed_cell(cell[0] + on[0], cell[1] + on[1], cell[2] + on[2], seed);
        // the twelve edges of a cube, four of them twice
        constexpr float kEdges[16][3] = {
            {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
            {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, -1, -1}};
        const float* edge = kEdges[bits >> 28U];
        const float dot = edge[0] * (f[0] - static_cast<float>(on[0])) +
                          edge[1] * (f[1] - static_cast<float>(on[1])) +
                          edge[2] * (f[2] - static_cast<float>(on[2]));
        float w[3], dw[3];
        for (int k = 0; k < 3; ++k) {
            w[k] = on[k] != 0 ? fade[k] : 1 - fade[k];
            dw[k] = on[k] != 0 ? slope[k] : -slope[k];
        }
        const float weight = w[0] * w[1] * w[2];
        sum.value += weight * dot;
        sum.gradient.x() += weight * edge[0] + dw[0] * w[1] * w[2] * dot;
        sum.gradient.y() += weight * edge[1] + w[0] * dw[1] * w[2] * dot;
        sum.gradient.z() += weight * edge[2] + w[0] * w[1] * dw[2] * dot;
    }
    return sum;
}

/// `octaves` of solid_noise, each twice as fine and half as high, about -1 .. 1. The gradient is with respect
/// to `place`, which is stretched by `scale` first.
inline NoiseValue fractal_noise(const Vec3f& place, const Vec3f& scale, int octaves, std::uint32_t seed) {
    NoiseValue sum;
    float height = 1, total = 0;
    Vec3f stretch = scale;
    for (int octave = 0; octave < octaves; ++octave) {
        const NoiseValue n =
            solid_noise(place.cwiseProduct(stretch), seed + 0x9E3779B9U * static_cast<std::uint32_t>(octave));
        sum.value += height * n.value;
        sum.gradient += height * n.gradient.cwiseProduct(stretch);
        total += height;
        height *= 0.5F;
        stretch *= 2.03F;
    }
    return {sum.value / total, sum.gradient / total};
}

/// How far inside its cell a place is: the distance to the second nearest of a cloud of points, one to a unit
/// cube, less that to the nearest; 0 on the borders (Worley, "A cellular texture basis function" (1996),
/// doi:10.1145/237170.237267).
inline NoiseValue cell_noise(const Vec3f& place, std::uint32_t seed) {
    const Vec3f whole = place.array().floor();
    const auto x = static_cast<std::int32_t>(whole.x()), y = static_cast<std::int32_t>(whole.y()),
               z = static_cast<std::int32_t>(whole.z());
    const Vec3f f = place - whole;
    float first_sq = 1e9F, second_sq = 1e9F;
    Vec3f first = Vec3f::Zero(), second = Vec3f::Zero();
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
            for (int k = -1; k <= 1; ++k) {
                const std::uint32_t bits = hashed_cell(x + i, y + j, z + k, seed);
                const Vec3f to_point =
                    Vec3f(static_cast<float>(i) + static_cast<float>(bits & 0x3FFU) * 0x1p-10F,
                          static_cast<float>(j) + static_cast<float>(bits >> 10U & 0x3FFU) * 0x1p-10F,
                          static_cast<float>(k) + static_cast<float>(bits >> 20U & 0x3FFU) * 0x1p-10F) -
                    f;
                const float distance_sq = to_point.squaredNorm();
                if (distance_sq < first_sq) {
                    second_sq = first_sq;
                    second = first;
                    first_sq = distance_sq;
                    first = to_point;
                } else if (distance_sq < second_sq) {
                    second_sq = distance_sq;
                    second = to_point;
                }
            }
    const float d1 = std::sqrt(first_sq), d2 = std::sqrt(second_sq);
    return {d2 - d1, first / std::max(d1, 1e-4F) - second / std::max(d2, 1e-4F)};
}

}  // namespace windfall::picture
