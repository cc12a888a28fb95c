#pragma once
// Noise and random numbers of the fracture surfaces, inline and in single precision: a break asks for a
// million of them in a few milliseconds. Every number is a hash of (seed, purpose, particle), never the next
// of a sequence, so that a change of one parameter leaves all others' numbers as they were.
#include <cmath>
#include <cstdint>

namespace windfall::fracture {

/// Keeps the numbers of one use apart from those of another.
enum class NoisePurpose : std::uint32_t {
    NodeRadius = 1,
    NodeAngle,
    WarpX,
    WarpY,
    BandOffset,
    BundleHeight,
    BundleDirection,
    BundleSlope,
    BundleName,
    Roughness,
    WhiteNoise,
    ThornStub,
    ThornPiece,
    ThornLength,
    ThornShape,
    Strand,
    StrandShape,
    Strip,
    Bark,
    Outline,
    Crack,
    Colour,
    Fibre,
    PithName,
    LayerName,
    BreakingBond,
    BreakingFibre,
};

/// 32 bits to 32 well mixed bits, one to one (Wellons' "lowbias32").
inline std::uint32_t mixed_bits(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    return x ^ (x >> 16U);
}

/// 64 bits of a recipe's seed in 32.
inline std::uint32_t noise_seed(std::int64_t seed) {
    const auto bits = static_cast<std::uint64_t>(seed);
    return mixed_bits(static_cast<std::uint32_t>(bits)) ^ static_cast<std::uint32_t>(bits >> 32U);
}

/// The random bits of a particle. `purpose_index` tells apart levels, octaves and the like.
inline std::uint32_t noise_key(std::uint32_t seed, NoisePurpose purpose, std::uint32_t i, std::uint32_t j = 0,
                               std::uint32_t purpose_index = 0) {
    const std::uint32_t stream =
        mixed_bits(seed + 0x9e3779b9U * (static_cast<std::uint32_t>(purpose) + 64U * purpose_index));
    return mixed_bits(mixed_bits(stream + i * 0x85ebca6bU) + j * 0xc2b2ae35U);
}

/// Uniform in [0, 1) from random bits.
inline float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }

inline float random_unit(std::uint32_t seed, NoisePurpose purpose, std::uint32_t i, std::uint32_t j = 0,
                         std::uint32_t purpose_index = 0) {
    return unit_float(noise_key(seed, purpose, i, j, purpose_index));
}

/// Gradient noise in the plane (Perlin 2002, with eight gradients), about -1 .. 1, zero at whole coordinates.
/// Without branches, so that loops over it become vector code. |x|, |y| < 2^30.
inline float gradient_noise(std::uint32_t seed, float x, float y) {
    const auto floor_of = [](float v) {
        const int whole = static_cast<int>(v);
        return whole - static_cast<int>(v < static_cast<float>(whole));
    };
    const auto slope = [](std::uint32_t bits, float u, float v) {
        const float a = (bits & 1U) != 0 ? u : -u;
        const float b = (bits & 2U) != 0 ? v : -v;
        return (bits & 4U) != 0 ? a + 0.5F * b : b + 0.5F * a;
    };
    const int ix = floor_of(x), iy = floor_of(y);
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const auto ux = static_cast<std::uint32_t>(ix), uy = static_cast<std::uint32_t>(iy);
    const std::uint32_t left = mixed_bits(ux * 0x85ebca6bU + seed);
    const std::uint32_t right = mixed_bits((ux + 1) * 0x85ebca6bU + seed);
    const std::uint32_t low = uy * 0xc2b2ae35U, high = (uy + 1) * 0xc2b2ae35U;
    const float s00 = slope(mixed_bits(left + low) >> 5U, fx, fy);
    const float s10 = slope(mixed_bits(right + low) >> 5U, fx - 1, fy);
    const float s01 = slope(mixed_bits(left + high) >> 5U, fx, fy - 1);
    const float s11 = slope(mixed_bits(right + high) >> 5U, fx - 1, fy - 1);
    const float u = fx * fx * fx * (fx * (fx * 6 - 15) + 10);
    const float v = fy * fy * fy * (fy * (fy * 6 - 15) + 10);
    const float below = s00 + u * (s10 - s00), above = s01 + u * (s11 - s01);
    return below + v * (above - below);
}

/// 0 below `low`, 1 above `high`, smooth between.
inline float smooth_step(float low, float high, float x) {
    float t = (x - low) / (high - low);
    t = t < 0 ? 0 : (t > 1 ? 1 : t);
    return t * t * (3 - 2 * t);
}

}  // namespace windfall::fracture
