#pragma once
// Random numbers by counter (Salmon et al. 2011, Philox4x32-10): a number depends on its key alone, never on
// how many were drawn before it or by which thread.
#include <array>
#include <cstdint>

namespace windfall {

/// Purposes keep streams apart, so that a new use of random numbers does not reshuffle an old one.
enum class RandomPurpose : std::uint32_t {
    ImperfectionNoise = 1,
    ImperfectionModes = 2,
    LanczosStart = 3,
    PictureSample = 4,
    PictureMottle = 5,
    RotWounds = 6,
    PileSizes = 7,
};

/// Four independent numbers, uniform in [0, 1), for (seed, purpose, index, sub_index).
std::array<double, 4> random_uniform4(std::uint64_t seed, RandomPurpose purpose, std::uint64_t index,
                                      std::uint32_t sub_index = 0);

/// Two independent standard normal numbers for the same key (Box-Muller).
std::array<double, 2> random_normal2(std::uint64_t seed, RandomPurpose purpose, std::uint64_t index,
                                     std::uint32_t sub_index = 0);

}  // namespace windfall
