#pragma once
// Recipes of branches drawn at random from the ranges of Table 2 (Yang et al. 2019) and of what goes beyond
// it.
#include <random>

#include "fracture/parameters.h"

namespace windfall::test {

/// The same number gives the same recipe. At most `most_rings` rings and `most_sectors` sectors.
inline fracture::FractureParameters random_branch(std::uint32_t number, std::int64_t most_rings,
                                                  std::int64_t most_sectors) {
    std::mt19937 generator(number);
    const auto u = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
    };
    const auto whole = [&](std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(u(0, 1) * static_cast<double>(high - low + 1));
    };
    const auto chance = [&](double p) { return u(0, 1) < p; };
    fracture::FractureParameters p;
    p.seed = number;
    p.branch.diameter_m = u(0.005, 5);
    p.branch.rings = whole(3, most_rings);
    p.branch.sectors = whole(10, most_sectors);
    p.branch.layers = whole(2, 12);
    p.branch.length = u(0.5, 6);
    p.branch.piece_length = u(0.5, 6);
    p.branch.taper = u(0, 0.01);
    p.branch.bark_relief = u(0, 0.1);
    p.branch.outline = u(0, 0.1);
    p.tissue.pith = u(0, 0.2);
    p.tissue.heartwood = u(0, 0.5);
    p.tissue.phloem = u(0, 0.3);
    p.fracture.tilt_deg = u(0, 70);
    p.fracture.tilt_direction_deg = u(0, 360);
    if (chance(0.3)) {
        p.fracture.height_from = fracture::HeightSource::Asked;
        p.fracture.mean_height = u(0.1, 8);
    }
    if (chance(0.5)) p.high = {u(0, 20), u(0, 360), u(0, 360), u(0, 1)};
    if (chance(0.5)) p.low = {u(-20, 0), u(0, 360), u(0, 360), u(0, 1)};
    const auto lambda = [&] { return chance(0.2) ? u(0, 5) : u(0, 0.2); };
    p.roughness = {lambda(),    lambda(),    lambda(),    u(1, 10000),
                   u(1, 10000), u(1, 10000), whole(1, 3), whole(0, 3)};
    if (chance(0.5)) {
        p.thorns = {u(0, 2), u(0, 1), u(0, 2), u(0, 1), u(0, 2), u(0, 1), u(0, 2), u(0, 1), u(0.5, 3)};
        if (chance(0.5)) p.ductile = {u(0, 40), u(0, 1), u(0, 360), u(0, 360), u(0, 1)};
    }
    if (chance(0.6)) {
        const std::int64_t levels = whole(1, 4);
        double size = u(0.2, 0.8);
        for (std::int64_t level = 0; level < levels; ++level) {
            p.bundles.radial.push_back(size);
            p.bundles.angular.push_back(size * u(0.7, 3));
            p.bundles.amplitude.push_back(u(0, 3));
            p.bundles.slope.push_back(u(0, 5));
            size *= u(0.2, 0.7);
        }
        p.bundles.skew = u(1, 3);
        p.bundles.terraces = u(0, 1);
        p.bundles.warp = u(0, 0.15);
        p.bundles.warp_frequency = u(0.5, 5);
        p.bundles.compression = u(0, 1);
        p.bundles.bark_amplitude = u(0, 2);
        p.bundles.bark_offset = u(-1, 1);
    }
    p.fringe.strands = chance(0.5) ? whole(0, 200) : 0;
    p.fringe.strips = chance(0.3) ? whole(0, 3) : 0;
    p.output.piece = fracture::PiecePlace::Above;
    return p;
}

}  // namespace windfall::test
