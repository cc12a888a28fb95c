#pragma once
// Cracks drawn at random from their ranges.
#include <cmath>
#include <cstdint>
#include <random>

#include "fracture/parameters.h"

namespace windfall::test {

/// Gives a recipe random cracks and a random wood; the same number gives the same cracks. Many of them are
/// wider and closer than any wood's.
inline void add_random_cracks(std::uint32_t number, fracture::FractureParameters& p) {
    std::mt19937 generator(number);
    const auto u = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
    };
    const auto scale = [&](double low, double high) { return std::exp(u(std::log(low), std::log(high))); };
    const bool wild = number % 3 == 0;
    const auto draw = [&](fracture::CrackClass& cracks, double most, double longest) {
        cracks.count = static_cast<std::int64_t>(u(0, wild ? 5 * most : most));
        cracks.gap_deg = u(0, 1) < 0.5 ? 0 : u(1, 360);
        cracks.length = scale(0.01, longest);
        cracks.depth = scale(0.01, 20);
        cracks.width = scale(0.0005, wild ? 0.5 : 0.03);
    };
    draw(p.cracks.large, 10, 1);
    draw(p.cracks.medium, 30, 1);
    draw(p.cracks.small, 80, 1);
    draw(p.cracks.tangential, 10, 6.3);
    p.cracks.check = u(0, 1) < 0.6;
    p.cracks.check_angle_deg = u(0, 360);
    p.cracks.check_depth = scale(0.01, 20);
    p.cracks.check_relief = u(0, wild ? 3 : 1);
    p.cracks.irregularity = u(0, wild ? 0.2 : 0.05);
    p.species.shrinkage_tangential = u(0, 0.3);
    p.species.shrinkage_radial = u(0, 0.1);
}

}  // namespace windfall::test
