// The roughness of a break: Yang et al. 2019, equation (1), and its spectrum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/break_ends.h"
#include "fracture/broken_branch.h"
#include "support/flat_break.h"

namespace windfall::fracture {
namespace {

constexpr double kPi = std::numbers::pi;

/// Mean square of the heights, and of their difference between neighbours on a ray.
std::pair<double, double> roughness_of(FractureParameters p) {
    double square = 0, difference = 0;
    std::size_t count = 0;
    for (int seed = 1; seed <= 6; ++seed) {
        p.seed = seed;
        const BreakEnds ends = ends_of(p);
        for (int s = 0; s < ends.cells.sectors; ++s)
            for (int r = 1; r < ends.cells.rings; ++r) {
                const auto& v = ends.cells.of(r, s);
                const double a = ends.stub.positions[static_cast<std::size_t>(v[0])].z();
                const double b = ends.stub.positions[static_cast<std::size_t>(v[1])].z();
                square += a * a;
                difference += (b - a) * (b - a);
                ++count;
            }
    }
    return {square / static_cast<double>(count), difference / static_cast<double>(count)};
}

TEST(BreakRoughness, RoughnessFollowsLambdaAndBeta) {
    FractureParameters p = flat(200, 48);
    p.branch.diameter_m = 0.02;
    p.roughness.octaves = 1;
    p.roughness.heartwood = 0.1;
    p.roughness.heartwood_frequency = 600;  // 6 periods a radius
    const auto [square, difference] = roughness_of(p);
    EXPECT_NEAR(std::sqrt(square) / 0.1, 0.3, 0.12);  // Perlin noise has a deviation of about 0.3

    p.roughness.heartwood = 0.3;
    const auto [square3, difference3] = roughness_of(p);
    EXPECT_NEAR(square3 / square, 9, 0.01);
    EXPECT_NEAR(difference3 / difference, 9, 0.01);

    p.roughness.heartwood = 0.1;
    p.roughness.heartwood_frequency = 1200;
    const auto [square2, difference2] = roughness_of(p);
    EXPECT_NEAR(square2 / square, 1, 0.15);
    // Slopes double with the frequency.
    EXPECT_NEAR(difference2 / difference, 4, 0.7);

    // The same waves in metres on a branch of twice the size are twice as many a radius.
    p.roughness.heartwood_frequency = 600;
    p.branch.diameter_m = 0.04;
    EXPECT_NEAR(roughness_of(p).second / difference2, 1, 1e-3);
}

/// Mean periodogram of the heights along rays between the radii `from` and `to`; entry k: k periods over that
/// way.
std::vector<double> spectrum_along_rays(FractureParameters p, double from, double to) {
    std::vector<double> power;
    double rays = 0;
    for (p.seed = 1; p.seed <= 4; ++p.seed) {
        const BreakEnds ends = ends_of(p);
        const int first = static_cast<int>(from * ends.cells.rings),
                  last = static_cast<int>(to * ends.cells.rings);
        const auto count = static_cast<std::size_t>(last - first);
        power.resize(count / 2, 0.0);
        for (int s = 0; s < ends.cells.sectors; ++s, ++rays) {
            std::vector<double> z;
            double mean = 0;
            for (int r = first; r < last; ++r) {
                z.push_back(ends.stub.positions[static_cast<std::size_t>(ends.cells.of(r, s)[0])].z());
                mean += z.back() / static_cast<double>(count);
            }
            for (std::size_t k = 1; k < power.size(); ++k) {
                double real = 0, imaginary = 0;
                for (std::size_t i = 0; i < count; ++i) {
                    const double at = static_cast<double>(i) / static_cast<double>(count);
                    const double window = 1 - std::cos(2 * kPi * at);
                    real += window * (z[i] - mean) * std::cos(2 * kPi * at * static_cast<double>(k));
                    imaginary += window * (z[i] - mean) * std::sin(2 * kPi * at * static_cast<double>(k));
                }
                power[k] += real * real + imaginary * imaginary;
            }
        }
    }
    for (double& value : power) value /= rays;
    return power;
}

/// Share of the power at more than `k` periods.
double share_above(const std::vector<double>& power, double k) {
    double above = 0, all = 0;
    for (std::size_t i = 1; i < power.size(); ++i) {
        all += power[i];
        if (static_cast<double>(i) > k) above += power[i];
    }
    return above / all;
}

/// One octave of Perlin noise has its waves below about one and a half per unit of beta radius, most of them
/// around 0.7; what lies beyond is cut off. In each tissue by its own beta.
TEST(BreakRoughness, SpectrumOfTheRoughnessEndsAtBeta) {
    FractureParameters p = flat(240, 24);
    p.branch.diameter_m = 0.02;
    p.roughness.octaves = 1;
    const auto check_tissue = [&](double RoughnessParameters::*lambda, double RoughnessParameters::*beta) {
        p.roughness.phloem = p.roughness.sapwood = p.roughness.heartwood = 0;
        p.roughness.*lambda = 0.1;
        std::vector<double> last;
        for (const double frequency : {1000.0, 2000.0, 4000.0}) {
            p.roughness.*beta = frequency;
            const double periods = frequency * 0.01 * 0.8;  // over 0.8 radii
            const auto power = spectrum_along_rays(p, 0.15, 0.95);
            EXPECT_LT(share_above(power, 2 * periods), 0.03) << frequency;
            EXPECT_NEAR(share_above(power, 0.35 * periods), 0.6, 0.1) << frequency;
            last = power;
        }
        p.roughness.*lambda = 0.2;
        const auto twice = spectrum_along_rays(p, 0.15, 0.95);
        for (std::size_t k = 1; k < last.size(); ++k) ASSERT_NEAR(twice[k] / last[k], 4, 0.02) << k;
    };
    p.tissue = {0, 1, 0};
    check_tissue(&RoughnessParameters::heartwood, &RoughnessParameters::heartwood_frequency);
    p.tissue = {0, 0, 0};
    check_tissue(&RoughnessParameters::sapwood, &RoughnessParameters::sapwood_frequency);
    p.tissue = {0, 0, 1};
    check_tissue(&RoughnessParameters::phloem, &RoughnessParameters::phloem_frequency);
}

TEST(BreakRoughness, SpectrumOfOctavesAndOfWhiteNoise) {
    FractureParameters p = flat(240, 24);
    p.branch.diameter_m = 0.02;
    p.roughness.heartwood = 0.1;
    p.roughness.heartwood_frequency = 1000;  // 8 waves over 0.8 radii
    p.roughness.octaves = 1;
    const auto one = spectrum_along_rays(p, 0.15, 0.95);
    p.roughness.octaves = 3;
    const auto three = spectrum_along_rays(p, 0.15, 0.95);
    // Each octave has twice the frequency and a quarter of the power: 1/16 of it beyond 4 x 0.35 x 8.
    EXPECT_GT(share_above(three, 16), 4 * share_above(one, 16));
    EXPECT_LT(share_above(three, 64), 0.03);
    p.roughness.octaves = 0;
    p.roughness.white_octaves = 1;
    const auto white = spectrum_along_rays(p, 0.15, 0.95);
    // As much in each half of the band.
    EXPECT_NEAR(share_above(white, 0.5 * static_cast<double>(white.size())), 0.5, 0.05);
}

}  // namespace
}  // namespace windfall::fracture
