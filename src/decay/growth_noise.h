#pragma once
// Random numbers of growth, inline and in single precision: every number is a hash of (seed, purpose, place),
// never the next of a sequence.
#include <cmath>
#include <cstdint>

#include "geometry/surface_mesh.h"

namespace windfall::decay {

/// Keeps the numbers of one use apart from those of another.
enum class GrowthNoise : std::uint32_t { Motility = 1, Nutrient, Step, Spread, SpreadPlace };

/// 32 bits to 32 well mixed bits, one to one (Wellons' "lowbias32").
inline std::uint32_t scrambled(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    return x ^ (x >> 16U);
}

/// The key of one stream of numbers: a seed, what they are for, and up to two indices.
inline std::uint32_t noise_stream(std::uint64_t seed, GrowthNoise purpose, std::uint64_t i = 0,
                                  std::uint64_t j = 0) {
    std::uint32_t key = scrambled(static_cast<std::uint32_t>(seed));
    key = scrambled(key ^ static_cast<std::uint32_t>(seed >> 32U));
    key = scrambled(key + 0x9e3779b9U * static_cast<std::uint32_t>(purpose));
    key = scrambled(key ^ static_cast<std::uint32_t>(i));
    key = scrambled(key + 0x85ebca6bU * static_cast<std::uint32_t>(i >> 32U));
    key = scrambled(key ^ static_cast<std::uint32_t>(j));
    return scrambled(key + 0xc2b2ae35U * static_cast<std::uint32_t>(j >> 32U));
}

/// Uniform in [0, 1) from random bits.
inline float unit_interval(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }

/// Value noise on a cubic lattice of unit spacing, smoothly blended, within -1 .. 1 (r.m.s. about 0.3).
/// |coordinates| < 2^30.
inline float value_noise(std::uint32_t key, const geometry::Vec3& place) {
    const geometry::Vec3 whole = place.array().floor();
    const auto x = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole.x()));
    const auto y = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole.y()));
    const auto z = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole.z()));
    const geometry::Vec3 f = place - whole;
    const geometry::Vec3 blend = f.array() * f.array() * (3 - 2 * f.array());
    double sum = 0;
    for (std::uint32_t c = 0; c < 8; ++c) {
        const std::uint32_t a = c & 1U, b = (c >> 1U) & 1U, e = c >> 2U;
        const double weight = (a != 0 ? blend.x() : 1 - blend.x()) * (b != 0 ? blend.y() : 1 - blend.y()) *
                              (e != 0 ? blend.z() : 1 - blend.z());
        const std::uint32_t bits = scrambled(scrambled(scrambled(key ^ (x + a)) + y + b) + z + e);
        sum += weight * (2 * static_cast<double>(unit_interval(bits)) - 1);
    }
    return static_cast<float>(sum);
}

}  // namespace windfall::decay
