// Diffusion with a surface that resists and one that does not, against series solutions.
#include <gtest/gtest.h>

#include <cstdio>

#include "support/flesh_ball.h"

namespace windfall::drying {
namespace {

TEST(FleshSeries, BallThatEvaporatesIsTheSeries) {
    const FleshBall ball(16, 16, kNoStone);
    for (const double biot : {0.5, 5.0})
        for (const double t : {0.05, 0.2})
            EXPECT_NEAR(ball.dried(biot, t, 20) / evaporating_ball(biot, t), 1, 0.01)
                << "Biot " << biot << " t " << t;
}

TEST(FleshSeries, DrySurfaceIsTheSeries) {
    // Evaporation so fast that the surface is dry at once: Crank's eq. (6.20).
    const FleshBall ball(16, 16, kNoStone);
    const double t = 0.1;
    double sum = 0;
    for (int k = 1; k < 50; ++k)
        sum += 6 / std::pow(k * std::numbers::pi, 2) * std::exp(-std::pow(k * std::numbers::pi, 2) * t);
    EXPECT_NEAR(ball.dried(1e4, t, 40) / sum, 1, 0.01);
}

TEST(FleshSeries, ErrorFallsWithTheSquareOfTheLayers) {
    // Against a finer mesh of the same facets, which the ball's series knows nothing of.
    const auto dried = [](int layers) { return FleshBall(8, layers, kNoStone).dried(5, 0.05, 20); };
    const double finest = dried(32);
    const double coarse = std::abs(dried(8) - finest);
    const double fine = std::abs(dried(16) - finest);
    std::printf("8 layers: error %.2e, 16: %.2e\n", coarse, fine);
    EXPECT_GT(coarse / fine, 4);  // (1/8^2 - 1/32^2) / (1/16^2 - 1/32^2) = 5
}

}  // namespace
}  // namespace windfall::drying
