#include "fracture/fractal_dimension.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <unsupported/Eigen/FFT>

namespace windfall::fracture {
namespace {

template <class Height>
HeightGrid grid_of(int side, double spacing, const Height& height) {
    HeightGrid grid{side, spacing, {}};
    for (int row = 0; row <= side; ++row)
        for (int column = 0; column <= side; ++column)
            grid.heights.push_back(static_cast<float>(height(column * spacing, row * spacing)));
    return grid;
}

TEST(FractalDimension, OfPlanesIsTwo) {
    for (const double slope : {0.0, 0.3, 1.0, 5.0})
        EXPECT_NEAR(box_counting_dimension(grid_of(
                        256, 1.0 / 256, [&](double x, double y) { return slope * x + 0.3 * slope * y; })),
                    2, 0.03)
            << slope;
}

TEST(FractalDimension, OfASmoothHillIsTwo) {
    EXPECT_NEAR(box_counting_dimension(grid_of(
                    256, 1.0 / 256, [](double x, double y) { return std::sin(3 * x) * std::cos(2 * y); })),
                2, 0.03);
}

TEST(FractalDimension, OfNoiseFromNodeToNodeIsNearThree) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 10);
    EXPECT_GT(
        box_counting_dimension(grid_of(256, 1.0 / 256, [&](double, double) { return uniform(random); })),
        2.85);
}

/// A surface whose increments over a distance r have the standard deviation `steepness` r^H (in units of the
/// square's edge): Fourier synthesis with a power spectrum k^-(2 H + 2). Its dimension is 3 - H.
HeightGrid fractional_brownian_surface(double hurst, int side, unsigned seed) {
    const int period = 2 * side;  // the part that is kept does not meet its own repetition
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::vector<std::complex<double>>> waves(
        static_cast<std::size_t>(period),
        std::vector<std::complex<double>>(static_cast<std::size_t>(period)));
    for (int v = 0; v < period; ++v)
        for (int u = 0; u < period; ++u) {
            const double kx = u <= period / 2 ? u : u - period, ky = v <= period / 2 ? v : v - period;
            const double k = std::hypot(kx, ky);
            const std::complex<double> amplitude{normal(random), normal(random)};
            waves[v][u] = k == 0 ? 0 : amplitude * std::pow(k, -hurst - 1);
        }
    Eigen::FFT<double> fft;
    std::vector<std::complex<double>> line(static_cast<std::size_t>(period)), result;
    for (auto& row : waves) {
        fft.inv(result, row);
        row = result;
    }
    for (int u = 0; u < period; ++u) {
        for (int v = 0; v < period; ++v) line[v] = waves[v][u];
        fft.inv(result, line);
        for (int v = 0; v < period; ++v) waves[v][u] = result[v];
    }
    double mean_square = 0;  // of increments over the quarter of an edge
    for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u)
            mean_square += std::pow(waves[v][u].real() - waves[v][u + side / 4].real(), 2) / side / side;
    constexpr double kSteepness =
        20;  // steep enough that cubes on the surface's flanks outnumber its columns
    const double scale = kSteepness / std::sqrt(mean_square);
    return grid_of(side, 1.0 / side, [&](double x, double y) {
        return scale * waves[std::lround(y * side)][std::lround(x * side)].real();
    });
}

TEST(FractalDimension, OfFractionalBrownianSurfacesIsThreeMinusH) {
    for (const double hurst : {0.25, 0.5, 0.75}) {
        const double dimension = box_counting_dimension(fractional_brownian_surface(hurst, 256, 3));
        EXPECT_NEAR(dimension, 3 - hurst, 0.1) << "H = " << hurst;
        RecordProperty("dimension_" + std::to_string(hurst), std::to_string(dimension));
    }
}

TEST(FractalDimension, RisesWithTheHeightOfFineNoise) {
    double before = 0;
    for (const double lambda : {0.0, 0.005, 0.02, 0.06, 0.2, 1.0}) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform(0, lambda + 1e-12);
        const double dimension =
            box_counting_dimension(grid_of(256, 1.24 / 256, [&](double, double) { return uniform(random); }));
        EXPECT_GT(dimension, before) << lambda;
        before = dimension;
    }
}

TEST(HeightGrid, IsTheHighestOfTheTriangles) {
    const auto quad = [](float z, float half) {
        return std::vector<Triangle>{
            {{{-half, -half, z}, {half, -half, z}, {half, half, z + 2 * half}}},
            {{{-half, -half, z}, {half, half, z + 2 * half}, {-half, half, z + 2 * half}}}};
    };
    std::vector<Triangle> triangles = quad(0, 1);
    triangles.push_back({{{0, 0, -1}, {0, 0, 5}, {0.5F, 0.5F, 5}}});  // upright
    const HeightGrid slope = height_grid(triangles, 0.5, 64);
    ASSERT_EQ(slope.heights.size(), 65U * 65U);
    for (int row = 0; row <= 64; ++row)
        for (int column = 0; column <= 64; ++column)
            ASSERT_NEAR(slope.at(column, row), 1 + (row - 32) / 64.0, 1e-5) << column << " " << row;
    triangles = quad(9, 0.25F);
    for (Triangle& t : triangles)
        for (auto& corner : t) corner.z() = 9;
    auto both = quad(0, 1);
    both.insert(both.end(), triangles.begin(), triangles.end());
    const HeightGrid step = height_grid(both, 0.5, 64);
    EXPECT_EQ(step.at(32, 32), 9);
    EXPECT_EQ(step.at(16, 32), 9);
    EXPECT_LT(step.at(14, 32), 2);
}

TEST(HeightGrid, FillsGapsFromBeforeThem) {
    const std::vector<Triangle> half = {{{{-1, -1, 3}, {0.01F, -1, 3}, {0.01F, 1, 3}}},
                                        {{{-1, -1, 3}, {0.01F, 1, 3}, {-1, 1, 3}}}};
    const HeightGrid grid = height_grid(half, 0.5, 64);
    for (const float height : grid.heights) ASSERT_FLOAT_EQ(height, 3);
    EXPECT_THROW(height_grid({}, 0.5, 64), std::invalid_argument);
}

}  // namespace
}  // namespace windfall::fracture
