#include "decay/growth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "support/growth_ball.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;

constexpr double kWarm_c = 22;

/// Both organisms on two spots.
void plant_two_spots(GrowthBall& ball) {
    for (const Vec3& d : {Vec3(1, 0.3, 0.2), Vec3(0.8, -0.5, 0.4)}) {
        ball.growth.plant(0, ball.texel(d), 0.003, 0.3);
        ball.growth.plant(1, ball.texel(d), 0.003, 0.3);
    }
}

double largest(std::span<const float> values) { return *std::max_element(values.begin(), values.end()); }

TEST(Growth, KeepsTheSumOfAllMassOver500Frames) {
    GrowthBall ball(96);
    plant_two_spots(ball);
    const double start = ball.growth.total();
    for (int frame = 0; frame < 500; ++frame) ball.growth.advance(1, {});
    EXPECT_GT(ball.growth.area_over(1, 0.5), 0.2 * 4 * M_PI * 0.035 * 0.035);  // much has happened
    EXPECT_NEAR(ball.growth.total() / start, 1, 1e-6);
    EXPECT_NEAR(ball.growth.time_h(), 500, 1e-9);
}

TEST(Growth, PlantingAddsWhatItSays) {
    GrowthBall ball(64);
    const double before = ball.growth.total();
    const double planted = ball.growth.plant(0, ball.texel(Vec3(1, 1, 0)), 0.005, 0.4);
    EXPECT_GT(planted, 0);
    EXPECT_NEAR(ball.growth.total() - before, planted, 1e-9 * before);
    EXPECT_NEAR(largest(ball.growth.active(0)), 0.4, 1e-6);
    // A second, weaker planting in the same place adds nothing.
    EXPECT_EQ(ball.growth.plant(0, ball.texel(Vec3(1, 1, 0)), 0.005, 0.4), 0);
}

TEST(Growth, FungusIsExactlyZeroWhereRotHasNeverBeen) {
    GrowthBall ball(96);
    EXPECT_EQ(ball.growth.plant(1, ball.texel(Vec3(0, 1, 0)), 0.004, 0.5), 0);  // no rot there
    plant_two_spots(ball);
    std::size_t inside = 0, outside = 0;
    for (int day = 0; day < 12; ++day) {
        ball.growth.advance(24, {});
        for (std::size_t i = 0; i < ball.growth.texel_count(); ++i) {
            const float fungus = ball.growth.active(1)[i] + ball.growth.inactive(1)[i];
            if (ball.growth.gate()[i] > 0) {
                inside += fungus > 0.1F ? 1 : 0;
            } else {
                ASSERT_EQ(fungus, 0) << i;
                ++outside;
            }
        }
    }
    EXPECT_GT(inside, 100U);
    EXPECT_GT(outside, 1000U);
}

TEST(Growth, StaysPositive) {
    GrowthBall ball(96);
    plant_two_spots(ball);
    for (int day = 0; day < 15; ++day) ball.growth.advance(24, {});
    // What rounding and the stages leave below zero at a front is dust of that size.
    for (std::size_t o = 0; o < 2; ++o) {
        for (const float value : ball.growth.active(o)) ASSERT_GE(value, 0);
        for (const float value : ball.growth.inactive(o)) ASSERT_GE(value, -1e-8);
    }
    for (const float value : ball.growth.nutrient()) ASSERT_GE(value, 0);
    EXPECT_LT(largest(ball.growth.inactive(1)), 1.5);
}

double mould_area_after(double temperature_c, double water_activity_inside, double hours) {
    GrowthBall ball(96, even_settings());
    // Rot grown in comfort first; then the mould is left alone with the conditions.
    ball.growth.plant(0, ball.texel(Vec3(1, 0, 0)), 0.003, 0.3);
    ball.growth.advance(100, {});
    ball.growth.plant(1, ball.texel(Vec3(1, 0, 0)), 0.003, 0.3);
    ball.growth.advance(hours,
                        {.temperature_c = temperature_c, .water_activity_inside = water_activity_inside});
    return ball.growth.area_over(1, 0.05);
}

TEST(Growth, ColdSlowsHeatAndDroughtStopGreenMould) {
    const double start = mould_area_after(kWarm_c, 0.98, 0);
    const double warm = mould_area_after(kWarm_c, 0.98, 72) - start;
    const double cold = mould_area_after(8, 0.98, 72) - start;
    ASSERT_GT(warm, start);
    EXPECT_GT(cold, 0);
    EXPECT_LT(cold, 0.5 * warm);
    EXPECT_LT(mould_area_after(4, 0.98, 72) - start, cold);
    EXPECT_EQ(mould_area_after(40, 0.98, 72), start);
    EXPECT_EQ(mould_area_after(kWarm_c, 0.5, 72), start);
}

TEST(Growth, DryAirStopsAThinBeginningOnIntactSkinAndAWetPlaceFreesIt) {
    const auto amount_after = [](double humidity, std::span<const float> wetness) {
        GrowthBall ball(64, even_settings(), 7, {.wetness = wetness, .nutrient = {}});
        ball.growth.plant(0, ball.texel(Vec3(1, 0, 0)), 0.004, 0.0015);
        const double before = ball.growth.total();
        ball.growth.advance(48, {.water_activity_skin = humidity});
        EXPECT_NEAR(ball.growth.total() / before, 1, 1e-7);
        return largest(ball.growth.active(0));
    };
    EXPECT_FLOAT_EQ(static_cast<float>(amount_after(0.5, {})), 0.0015F);
    EXPECT_GT(amount_after(0.98, {}), 0.003);
    const std::vector<float> wet(std::size_t{64} * 64, 1);
    EXPECT_GT(amount_after(0.5, wet), 0.003);
}

/// Mean distance along the sphere, in m, at which the rot's density falls through 0.1, in each of 12 sectors
/// about `middle`; found between texels.
std::vector<double> sector_radii(const GrowthBall& ball, const Vec3& middle) {
    constexpr int kSectors = 12;
    constexpr double kThreshold = 0.1;
    const Vec3 axis = middle.normalized();
    const Vec3 e = axis.unitOrthogonal(), f = axis.cross(e);
    std::vector<double> sum(kSectors, 0), count(kSectors, 0);
    const auto density = [&](std::size_t i) {
        return static_cast<double>(ball.growth.active(0)[i]) + ball.growth.inactive(0)[i];
    };
    const auto side = static_cast<std::size_t>(ball.atlas.side());
    for (const geometry::CubeAtlas::Run& run : ball.atlas.runs()) {
        for (std::size_t i = run.begin; i < run.end; ++i) {
            for (const std::size_t j : {i + 1, i + side}) {
                if (j >= ball.growth.texel_count() || !ball.atlas.covered(j)) continue;
                if ((density(i) >= kThreshold) == (density(j) >= kThreshold)) continue;
                const double t = (kThreshold - density(i)) / (density(j) - density(i));
                const Vec3 p =
                    ((1 - t) * ball.growth.positions_m()[i] + t * ball.growth.positions_m()[j]).normalized();
                const double turn = (std::atan2(p.dot(f), p.dot(e)) / M_PI + 1) / 2 * kSectors;
                const auto sector = static_cast<std::size_t>(turn) % kSectors;
                sum[sector] += 0.035 * std::acos(std::min(1.0, p.dot(axis)));
                count[sector] += 1;
            }
        }
    }
    std::vector<double> radii;
    for (int k = 0; k < kSectors; ++k) {
        EXPECT_GT(count[k], 0);
        radii.push_back(sum[k] / count[k]);
    }
    return radii;
}

TEST(Growth, ColoniesAreEquallyRoundInAChartAcrossASeamAtACornerAndWhereTheMapIsStretched) {
    struct Place {
        Vec3 direction;
        double stretch;
    };
    double reference = 0;
    for (const Place& place :
         {Place{Vec3(1, 0.01, 0.02), 1}, Place{Vec3(1, 1, 0), 1}, Place{Vec3(1, 1, 1), 1},
          Place{Vec3(1, 0.01, 0.02), 3}, Place{Vec3(1, 1, 0), 3}, Place{Vec3(0.2, 0.1, -1), 1.0 / 3}}) {
        GrowthBall ball(256, even_settings(), 7, {}, place.stretch);
        ball.growth.plant(0, ball.texel(place.direction), 0.003, 0.3);
        ball.growth.advance(96, {});
        const auto radii = sector_radii(ball, ball.growth.positions_m()[ball.texel(place.direction)]);
        double mean = 0;
        for (const double r : radii) mean += r / static_cast<double>(radii.size());
        if (reference == 0) reference = mean;
        EXPECT_GT(mean, 0.007);
        EXPECT_NEAR(mean / reference, 1, 0.05) << place.direction.transpose() << " x " << place.stretch;
        for (const double r : radii)
            EXPECT_NEAR(r / mean, 1, 0.05) << place.direction.transpose() << " x " << place.stretch;
    }
}

TEST(Growth, IsTheSameBitsOnOneAndTwoThreads) {
    const auto run = [](int threads) {
        const ThreadLimit limit(threads);
        GrowthBall ball(128);
        plant_two_spots(ball);
        ball.growth.advance(60, {});
        return ball.growth.save();
    };
    EXPECT_EQ(run(1), run(2));
}

TEST(Growth, GoesOnToTheSameBitsFromSavedState) {
    GrowthBall whole(64), resumed(64);
    plant_two_spots(whole);
    whole.growth.advance(30.5, {});
    const auto saved = whole.growth.save();
    whole.growth.advance(20.25, {});
    resumed.growth.restore(saved);
    resumed.growth.advance(20.25, {});
    EXPECT_EQ(whole.growth.save(), resumed.growth.save());
    EXPECT_NE(whole.growth.save(), saved);

    GrowthBall other_seed(64, {}, 8), other_side(128);
    EXPECT_THROW(other_seed.growth.restore(saved), InputError);
    EXPECT_THROW(other_side.growth.restore(saved), InputError);
    EXPECT_THROW(resumed.growth.restore(std::span(saved).first(10)), InputError);
}

TEST(Growth, NoiseIsKeyedBySeedAndMakesEdgesIrregular) {
    GrowthBall a(96, {}, 1), b(96, {}, 2);
    for (GrowthBall* ball : {&a, &b}) {
        ball->growth.plant(0, ball->texel(Vec3(1, 0, 0)), 0.003, 0.3);
        ball->growth.advance(72, {});
    }
    EXPECT_NE(sector_radii(a, Vec3(1, 0, 0)), sector_radii(b, Vec3(1, 0, 0)));
    const auto radii = sector_radii(a, Vec3(1, 0, 0));
    const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
    EXPECT_GT(*most / *least, 1.02);
    EXPECT_LT(*most / *least, 2);
}

TEST(Growth, EveryMotilityFormSpreads) {
    for (const MotilityForm form : {MotilityForm::Kawasaki, MotilityForm::Logistic, MotilityForm::Linear}) {
        const geometry::CubeAtlas atlas(64);
        auto organisms = rot_and_mould();
        organisms[0].form = form;
        Growth growth(atlas, ball_positions(atlas, 0.035), organisms, even_settings(), 1);
        growth.plant(0, growth.nearest_texel(Vec3(0.035, 0, 0)), 0.004, 0.3);
        const double start = growth.area_over(0, 0.1), total = growth.total();
        growth.advance(96, {});
        EXPECT_GT(growth.area_over(0, 0.1), 1.5 * start) << static_cast<int>(form);
        EXPECT_NEAR(growth.total() / total, 1, 1e-6) << static_cast<int>(form);
    }
}

TEST(Growth, LessNutrientFeedsLess) {
    GrowthBall rich(64, even_settings());
    const std::vector<float> poor_field(std::size_t{64} * 64, 0.5F);
    GrowthBall poor(64, even_settings(), 7, {.wetness = {}, .nutrient = poor_field});
    EXPECT_NEAR(largest(poor.growth.nutrient()), 0.5, 1e-6);
    for (GrowthBall* ball : {&rich, &poor}) {
        ball->growth.plant(0, ball->texel(Vec3(1, 0, 0)), 0.004, 0.3);
        ball->growth.advance(96, {});
    }
    EXPECT_LT(poor.growth.area_over(0, 0.1), rich.growth.area_over(0, 0.1));
}

TEST(Growth, SaysWhatIsWrong) {
    const geometry::CubeAtlas atlas(64);
    const auto positions = ball_positions(atlas, 0.035);
    auto organisms = rot_and_mould();
    const auto make = [&] { Growth(atlas, positions, organisms, {}, 1); };
    EXPECT_EQ(message_of(make), "no error");
    organisms[1].motility_m2_h = -1;
    EXPECT_NE(message_of(make).find("penicillium-digitatum"), std::string::npos);
    organisms = {rot_and_mould()[1]};
    EXPECT_NE(message_of(make).find("soft rot"), std::string::npos);
    organisms = std::vector<Organism>(6, rot_and_mould()[0]);
    EXPECT_NE(message_of(make).find("6 organisms"), std::string::npos);
    const std::vector<float> short_field(10);
    EXPECT_THROW(Growth(atlas, positions, rot_and_mould(), {}, 1, {.wetness = short_field, .nutrient = {}}),
                 InputError);
    auto folded = positions;
    folded[atlas.texel_at(Vec3(1, 0, 0))] = folded[atlas.texel_at(Vec3(1, 0, 0)) + 1];
    EXPECT_NE(message_of([&] { Growth(atlas, folded, rot_and_mould(), {}, 1); }).find("no area"),
              std::string::npos);
}

}  // namespace
}  // namespace windfall::decay
