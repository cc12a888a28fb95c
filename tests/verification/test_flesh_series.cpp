// Diffusion with a surface that resists and one that does not, against series solutions.
#include <gtest/gtest.h>

#include "support/flesh_ball.h"

namespace windfall::drying {
namespace {

TEST(FleshSeries, BallThatEvaporatesIsTheSeries) {
    const FleshBall ball(24, 16, kNoStone);
    for (const double biot : {0.5, 5.0})
        for (const double t : {0.05, 0.2})
            EXPECT_NEAR(ball.dried(biot, t, 20) / evaporating_ball(biot, t), 1, 0.01)
                << "Biot " << biot << " t " << t;
}

TEST(FleshSeries, DrySurfaceIsTheSeries) {
    // Evaporation so fast that the surface is dry at once: Crank's eq. (6.20).
    const FleshBall ball(24, 16, kNoStone);
    const double t = 0.1;
    double sum = 0;
    for (int k = 1; k < 50; ++k)
        sum += 6 / std::pow(k * std::numbers::pi, 2) * std::exp(-std::pow(k * std::numbers::pi, 2) * t);
    EXPECT_NEAR(ball.dried(1e4, t, 40) / sum, 1, 0.01);
}

TEST(FleshSeries, ErrorFallsWithTheSquareOfTheMesh) {
    const double exact = evaporating_ball(2, 0.1);
    const double coarse = FleshBall(6, 6, kNoStone).dried(2, 0.1, 20) - exact;
    const double fine = FleshBall(12, 12, kNoStone).dried(2, 0.1, 20) - exact;
    EXPECT_GT(std::abs(coarse / fine), 3);
}

}  // namespace
}  // namespace windfall::drying
