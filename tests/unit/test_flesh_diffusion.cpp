// Water in flesh against series solutions, and what must hold of any step.
#include "drying/flesh_diffusion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/flesh_ball.h"

namespace windfall::drying {
namespace {

using geometry::Vec3;

TEST(FleshDiffusion, BallThatEvaporatesIsTheSeries) {
    // More of them, finer, in tests/verification/test_flesh_series.cpp.
    const FleshBall ball(12, 12, kNoStone);
    EXPECT_NEAR(ball.dried(5, 0.1, 10) / evaporating_ball(5, 0.1), 1, 0.01);
}

TEST(FleshDiffusion, ErrorInTimeFallsWithTheSquareOfTheStep) {
    const FleshBall ball(8, 8, 0.4);
    const double finest = ball.dried(2, 0.1, 128);
    const double coarse = std::abs(ball.dried(2, 0.1, 4) - finest);
    const double fine = std::abs(ball.dried(2, 0.1, 8) - finest);
    EXPECT_GT(coarse / fine, 3.3);
    EXPECT_LT(coarse, 1e-3);
}

TEST(FleshDiffusion, SideToSideIsTheSeries) {
    // The slowest mode of a closed ball with one wet side: j_1(k r) cos, with j_1'(k) = 0.
    const FleshBall ball(12, 12, kNoStone);
    constexpr double kWave = 2.081575977818101;
    std::vector<double> contents(ball.cells.size());
    std::vector<double> heights(contents.size());
    for (std::size_t q = 0; q < ball.cells.quads(); ++q)
        for (std::size_t k = 0; k < ball.cells.layers(); ++k) {
            Vec3 centre = Vec3::Zero();
            for (const std::int32_t v : ball.mesh.brick.quads[q])
                centre +=
                    (ball.mesh.node(v, static_cast<int>(k)) + ball.mesh.node(v, static_cast<int>(k) + 1)) / 8;
            const std::size_t cell = q * ball.cells.layers() + k;
            const double x = kWave * centre.norm();
            heights[cell] = centre.y() * ball.cells.volumes()[cell];
            contents[cell] = 1 + (std::sin(x) / (x * x) - std::cos(x) / x) * centre.y() / centre.norm();
        }
    const auto moment = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < contents.size(); ++i) sum += contents[i] * heights[i];
        return sum;
    };
    const double before = moment();
    const FleshDiffusion diffusion(ball.cells, ball.conductances, 1);
    const SkinEvaporation closed = proportional(ball.mesh, 0);
    constexpr double kTime = 0.2;
    for (int i = 0; i < 10; ++i)
        EXPECT_LT(std::abs(diffusion.step(contents, kTime / 10, closed, closed)), 1e-12);
    EXPECT_NEAR(std::log(before / moment()) / (kWave * kWave * kTime), 1, 0.01);
}

TEST(FleshDiffusion, WhatEvaporatesIsWhatTheCellsLose) {
    const FleshBall ball(8, 6, 0.4);
    for (const double diffusivity : {1e-4, 1.0, 1e6}) {
        const FleshDiffusion diffusion(ball.cells, ball.conductances, diffusivity);
        SkinEvaporation skin = proportional(ball.mesh, 0.3);
        skin.solutes = 0.02;
        for (std::size_t q = 0; q < skin.leaving.size(); ++q) {
            skin.leaving[q] /= kManySolutes * (1 + static_cast<double>(q % 5));
            skin.arriving[q] = 0.3 * skin.leaving[q];
        }
        std::vector<double> contents(ball.cells.size(), 0.8);
        double lost = 0;
        for (int i = 0; i < 8; ++i) lost += diffusion.step(contents, 0.05, skin, skin);
        EXPECT_GT(lost, 1e-3 * ball.cells.volume());
        EXPECT_NEAR((0.8 - mean_of(ball.cells, contents)) * ball.cells.volume() / lost, 1, 1e-12)
            << "diffusivity " << diffusivity;
        EXPECT_GE(*std::min_element(contents.begin(), contents.end()), 0);
    }
}

TEST(FleshDiffusion, FastDiffusionLeavesNoDifferences) {
    const FleshBall ball(8, 6, 0.4);
    const FleshDiffusion diffusion(ball.cells, ball.conductances, 1e6);
    const SkinEvaporation skin = proportional(ball.mesh, 0.3);
    std::vector<double> contents(ball.cells.size(), 1);
    for (int i = 0; i < 4; ++i) diffusion.step(contents, 0.1, skin, skin);
    const auto [least, most] = std::minmax_element(contents.begin(), contents.end());
    EXPECT_LT(*most, 0.95);
    EXPECT_LT(*most - *least, 1e-6);
}

TEST(FleshCells, ShrinkingBodyConductsAsItsLengthsFall) {
    // D C^-1 with C = theta^2 I; turning the body changes nothing.
    const FleshBall ball(8, 4, 0.4);
    constexpr double kTheta = 0.7;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    std::vector<Vec3> nodes = ball.mesh.nodes;
    for (Vec3& node : nodes) node = kTheta * (turn * node);
    // The stone does not move with the nodes, so the innermost cells are left out.
    const FleshConductances shrunk = ball.cells.conductances(nodes);
    for (std::size_t q = 0; q < ball.cells.quads(); ++q)
        for (std::size_t k = 1; k < ball.cells.layers(); ++k) {
            const std::size_t cell = q * ball.cells.layers() + k;
            EXPECT_NEAR(shrunk.up[cell] * kTheta * kTheta / ball.conductances.up[cell], 1, 1e-10);
        }
    const std::vector<double> areas = ball.cells.skin_areas(nodes);
    const std::vector<double> fresh = ball.cells.skin_areas(ball.mesh.nodes);
    for (std::size_t q = 0; q < areas.size(); ++q) EXPECT_NEAR(areas[q] / fresh[q], kTheta * kTheta, 1e-12);
}

TEST(QuadEvaporation, SolvesTheBalanceAtTheSkin) {
    for (const double conductance : {1e-3, 1.0, 1e8})
        for (const double content : {0.01, 0.3, 0.8}) {
            const double leaving = 2;
            const double arriving = 0.7;
            const double solutes = 0.02;
            const auto out = [&](double m) { return leaving * m / (m + solutes) - arriving; };
            double low = 0;
            double high = content;
            for (int i = 0; i < 200; ++i) {
                const double middle = 0.5 * (low + high);
                (conductance * (content - middle) > out(middle) ? low : high) = middle;
            }
            const QuadEvaporation found = evaporation(content, conductance, leaving, arriving, solutes);
            EXPECT_NEAR(found.flux, std::max(0.0, out(low)), 1e-9);
            if (found.flux == 0) continue;
            const double h = 1e-6;
            const double slope = (evaporation(content + h, conductance, leaving, arriving, solutes).flux -
                                  evaporation(content - h, conductance, leaving, arriving, solutes).flux) /
                                 (2 * h);
            EXPECT_NEAR(found.slope / slope, 1, 1e-4);
        }
}

TEST(QuadEvaporation, DampAirGivesNothingBack) {
    const QuadEvaporation damp = evaporation(0.01, 1, 1, 0.9, 0.02);
    EXPECT_EQ(damp.flux, 0);
    EXPECT_EQ(damp.slope, 0);
}

}  // namespace
}  // namespace windfall::drying
