// The speed of growth's fronts against closed forms, with the solver's own stencil, stages and tiles.
#include <gtest/gtest.h>

#include <cmath>

#include "support/growth_ball.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;

constexpr double kRadius_m = 0.035;
constexpr double kGrowth_per_h = 0.125;

/// Angle from its middle that a colony's edge (density 0.5) has reached on the ball.
double front_angle(const Growth& growth) {
    return std::acos(1 - growth.area_over(0, 0.5) / (2 * M_PI * kRadius_m * kRadius_m));
}

/// Speed in m/h of the front of du/dt = D lap u + mu u (1 - u) about the equator of its colony, where its
/// curvature vanishes, and mu times the middle of the time of measuring.
struct Front {
    double speed_m_h = 0, growths = 0;
};

Front fisher_front(int side, double diffusivity_m2_h) {
    GrowthSettings settings = even_settings();
    settings.nutrient_motility_m2_h = diffusivity_m2_h;  // so that B + N stays 1
    auto organisms = rot_and_mould();
    organisms.resize(1);
    Organism& rot = organisms[0];
    rot.form = MotilityForm::Linear;
    rot.law = GrowthLaw::Logistic;
    rot.motility_m2_h = diffusivity_m2_h;
    rot.growth_per_h = kGrowth_per_h;
    rot.ageing_per_h = 0;
    rot.crowding = 1e30;
    // Best conditions: gamma = 1.
    const GrowthConditions best{.temperature_c = rot.species.temperature_c.optimum,
                                .water_activity_skin = rot.species.water_activity.optimum,
                                .water_activity_inside = rot.species.water_activity.optimum};
    const geometry::CubeAtlas atlas(side);
    Growth growth(atlas, ball_positions(atlas, kRadius_m), organisms, settings, 1);
    growth.plant(0, growth.nearest_texel(Vec3(kRadius_m, 0, 0)), 0.1 * kRadius_m, 1);
    double from = 0, from_h = 0;
    while (front_angle(growth) < 1.75 && growth.time_h() < 1000) {
        growth.advance(2, best);
        if (from == 0 && front_angle(growth) > 1.25) {
            from = front_angle(growth);
            from_h = growth.time_h();
        }
    }
    const double to_h = growth.time_h();
    return {(front_angle(growth) - from) * kRadius_m / (to_h - from_h), kGrowth_per_h * (from_h + to_h) / 2};
}

TEST(GrowthFront, OfTheLinearisedCaseRunsAtTwoRootRD) {
    // Width of the front sqrt(D / mu) = 0.02 radii.
    const double diffusivity_m2_h = kGrowth_per_h * std::pow(0.02 * kRadius_m, 2);
    const double law = 2 * std::sqrt(kGrowth_per_h * diffusivity_m2_h);
    double previous = 1;
    for (const int side : {128, 256, 512}) {
        const Front front = fisher_front(side, diffusivity_m2_h);
        // A front from a compact start comes up to speed as 1 - 3 / (4 mu t) (M. Bramson, Comm. Pure Appl.
        // Math. 31, 1978).
        const double expected = law * (1 - 0.75 / front.growths);
        const double error = std::abs(front.speed_m_h / expected - 1);
        RecordProperty("speed_over_law_" + std::to_string(side), std::to_string(front.speed_m_h / law));
        EXPECT_LT(error, 0.6 * previous) << side;
        previous = error;
        if (side == 512) {
            EXPECT_NEAR(front.speed_m_h / law, 1, 0.03);
        }
    }
}

}  // namespace
}  // namespace windfall::decay
