#pragma once
// Recipes of branches drawn at random from the whole ranges of the parameters (Yang et al. 2019, Table 2, and
// what goes beyond it).
#include <algorithm>
#include <cmath>
#include <random>

#include "core/error.h"
#include "fracture/parameters.h"
#include "support/random_cracks.h"

namespace windfall::test {

class BranchDraw {
  public:
    BranchDraw(std::mt19937& generator, std::int64_t most_rings, std::int64_t most_sectors)
        : m_generator(generator), m_most_rings(most_rings), m_most_sectors(most_sectors) {}

    fracture::FractureParameters draw() {
        fracture::FractureParameters p;
        draw_branch(p);
        draw_break(p);
        draw_roughness(p);
        draw_thorns(p);
        if (chance(0.6)) draw_bundles(p);
        draw_fringe(p);
        return p;
    }

  private:
    double u(double low, double high) {
        return low + (high - low) * static_cast<double>(m_generator()) / 4294967296.0;
    }
    /// Often small, now and then as large as can be.
    double most_small(double high) {
        if (chance(0.1)) return high;
        return chance(0.5) ? u(0, high) : high * std::pow(u(0, 1), 4);
    }
    double log_u(double low, double high) { return std::exp(u(std::log(low), std::log(high))); }
    std::int64_t whole(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(u(0, 1) * static_cast<double>(high - low + 1));
    }
    bool chance(double p) { return u(0, 1) < p; }
    fracture::LayerParameters layer(double low, double high) {
        return {u(low, high), u(0, 360), u(0, 360), u(0, 1)};
    }

    void draw_branch(fracture::FractureParameters& p) {
        p.branch.diameter_m = chance(0.5) ? u(1e-4, 5) : log_u(1e-4, 5);
        p.branch.rings = whole(3, m_most_rings);
        p.branch.sectors = whole(10, m_most_sectors);
        p.branch.layers = whole(2, 12);
        p.branch.length = chance(0.2) ? u(0.01, 100) : u(0.01, 6);
        p.branch.piece_length = chance(0.2) ? u(0.01, 100) : u(0.01, 6);
        p.branch.taper = chance(0.3) ? 0 : 0.2 * std::pow(u(0, 1), 4);
        p.branch.bend_deg = chance(0.7) ? 0 : 180 * std::pow(u(-1, 1), 5);
        p.branch.bark_relief = most_small(0.3);
        p.branch.bark_scale = log_u(0.1, 10);
        p.branch.outline = most_small(0.3);
        p.tissue.pith = u(0, 0.3);
        p.tissue.heartwood = u(0, 0.4);
        p.tissue.phloem = chance(0.2) ? 0 : u(0, 0.3);
    }

    void draw_break(fracture::FractureParameters& p) {
        p.fracture.tilt_deg = chance(0.2) ? 0 : u(0, 89);
        p.fracture.tilt_direction_deg = u(0, 360);
        if (chance(0.5)) p.high = layer(0, 20);
        if (chance(0.5)) p.low = layer(-20, 0);
        if (chance(0.3)) {
            p.fracture.height_from = fracture::HeightSource::Asked;
            p.fracture.mean_height = most_small(40);
        } else if (chance(0.2)) {
            p.fracture.height_from = fracture::HeightSource::Species;
            p.species.name = static_cast<fracture::SpeciesName>(whole(0, 4));
            p.species.density_g_cm3 = u(0.1, 2);
        }
        p.species.moisture = chance(0.5) ? fracture::Moisture::Wet : fracture::Moisture::Dry;
        if (chance(0.3)) {
            p.load.source = fracture::LoadSource::Bending;
            p.load.direction_deg = u(0, 360);
            p.load.twist = u(-10, 10);
        }
        const double place = u(0, 1);
        p.output.piece = fracture::PiecePlace::Above;
        if (place < 0.2) p.output.piece = fracture::PiecePlace::Beside;
        if (place < 0.05) p.output.piece = fracture::PiecePlace::Hidden;
        p.fracture.gap = chance(0.7) ? 0 : u(0, 100);
    }

    void draw_roughness(fracture::FractureParameters& p) {
        const auto lambda = [&] { return chance(0.2) ? u(0, 5) : most_small(0.5); };
        const auto beta = [&] { return log_u(1, 10000); };
        p.roughness.phloem = lambda();
        p.roughness.sapwood = lambda();
        p.roughness.heartwood = lambda();
        p.roughness.phloem_frequency = beta();
        p.roughness.sapwood_frequency = beta();
        p.roughness.heartwood_frequency = beta();
        p.roughness.octaves = whole(0, 8);
        p.roughness.white_octaves = chance(0.5) ? 0 : whole(0, 8);
    }

    void draw_thorns(fracture::FractureParameters& p) {
        const auto length = [&] { return most_small(40); };
        const auto share = [&] { return chance(0.3) ? 0 : u(0, 1); };
        p.thorns.skew = log_u(0.1, 10);
        if (chance(0.5)) {
            p.thorns.pith_length = length();
            p.thorns.pith_probability = share();
            p.thorns.heartwood_length = length();
            p.thorns.heartwood_probability = share();
            p.thorns.sapwood_length = length();
            p.thorns.sapwood_probability = share();
            p.thorns.phloem_length = length();
            p.thorns.phloem_probability = share();
        }
        if (chance(0.3)) p.ductile = {length(), u(0, 1), u(0, 360), u(0, 360), u(0, 1)};
    }

    void draw_bundles(fracture::FractureParameters& p) {
        const std::int64_t levels = whole(1, 6);
        double size = log_u(0.005, 6.3);
        for (std::int64_t level = 0; level < levels; ++level) {
            p.bundles.radial.push_back(size);
            p.bundles.angular.push_back(std::clamp(size * log_u(0.2, 5), 0.005, 6.3));
            p.bundles.amplitude.push_back(most_small(20));
            p.bundles.slope.push_back(most_small(20));
            size = std::clamp(size * u(0.2, 1.2), 0.005, 6.3);
        }
        p.bundles.skew = log_u(0.1, 10);
        p.bundles.terraces = u(0, 1);
        p.bundles.warp = most_small(0.5);
        p.bundles.warp_frequency = log_u(0.1, 20);
        p.bundles.compression = u(0, 1);
        p.bundles.bark_amplitude = most_small(5);
        p.bundles.bark_offset = u(-5, 5);
    }

    void draw_fringe(fracture::FractureParameters& p) {
        p.fringe.strands = chance(0.5) ? whole(0, 200) : 0;
        p.fringe.strand_length = most_small(10);
        p.fringe.strips = chance(0.3) ? whole(0, 6) : 0;
        p.fringe.strip_length = most_small(10);
    }

    std::mt19937& m_generator;
    std::int64_t m_most_rings, m_most_sectors;
};

/// The same number gives the same recipe, one that `check` lets pass: others are drawn again. At most
/// `most_rings` rings and `most_sectors` sectors. A part of them has drying cracks.
inline fracture::FractureParameters random_branch(std::uint32_t number, std::int64_t most_rings,
                                                  std::int64_t most_sectors) {
    std::mt19937 generator(number);
    BranchDraw recipes(generator, most_rings, most_sectors);
    while (true) {
        fracture::FractureParameters p = recipes.draw();
        p.seed = number;
        if (number % 6 == 5) add_random_cracks(number, p);
        try {
            fracture::check(p);
            return p;
        } catch (const InputError&) {
            continue;
        }
    }
}

}  // namespace windfall::test
