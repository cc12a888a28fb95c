// Drying by the hour: what evaporates, what shrinks, and that the water is all there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "drying/moisture_course.h"
#include "support/flesh_ball.h"
#include "support/message_of.h"
#include "water/transpiration.h"

namespace windfall::drying {
namespace {

using geometry::LayeredMesh;
using geometry::Vec3;
using ::testing::HasSubstr;

constexpr double kStone = 0.4;

DryingParameters by_the_hour() {
    DryingParameters p;
    p.moisture.hours = 100;
    p.moisture.transpiration_ug_s_m2_pa = 5;
    p.moisture.diffusivity_m2_s = 2e-10;
    p.moisture.sunshine = Sunshine::Always;
    p.climate.name = water::ClimateName::Constant;
    p.climate.temperature_c = 30;
    p.climate.humidity = 0.4;
    return p;
}

BodyNodes nodes_of(const LayeredMesh& mesh) {
    return [&mesh] { return mesh.nodes; };
}

struct Fruit {
    DryingParameters parameters;
    LayeredMesh mesh = flesh_ball(8, 6, kStone);
    MoistureCourse course;
    explicit Fruit(const DryingParameters& p, const SkinPaint& paint = {})
        : parameters(p), course(mesh, p, skin_exposure(mesh, p.moisture, paint, atlas_middles(mesh.brick))) {}

    /// Dries without moving, increment by increment.
    CourseState at(double hours) const {
        CourseState state = course.start();
        while (state.parameter < hours)
            state = course.increment(state, hours, parameters.solver.max_step, nodes_of(mesh)).to;
        return state;
    }
    Vec3 middle(std::size_t quad) const {
        Vec3 sum = Vec3::Zero();
        for (const std::int32_t v : mesh.brick.quads[quad]) sum += mesh.node(v, mesh.layers);
        return sum.normalized();
    }
    /// Mean moisture under the skin within 30 degrees of a direction.
    double moisture_near(const CourseState& state, const Vec3& direction) const {
        const std::vector<double> moisture = course.skin_moisture(state);
        double sum = 0;
        int count = 0;
        for (std::size_t q = 0; q < moisture.size(); ++q)
            if (middle(q).dot(direction) > 0.866) {
                sum += moisture[q];
                ++count;
            }
        return sum / count;
    }
};

TEST(Moisture, FreshSkinTranspiresAsInSrcWater) {
    const DryingParameters p = by_the_hour();
    const Fruit fruit(p);
    const std::vector<double> areas = fruit.course.cells().skin_areas(fruit.mesh.nodes);
    const SkinEvaporation skin = fruit.course.evaporation_at(0, areas);
    const double fresh = fruit.course.start().values.front();
    const double size = p.fruit.size_m;
    double area = 0;
    double volume = 0;
    for (std::size_t q = 0; q < areas.size(); ++q) {
        area += areas[q];
        volume += skin.leaving[q] * fresh / (fresh + skin.solutes) - skin.arriving[q];
    }
    const double expected =
        water::transpiration_kg_per_s({.coefficient_ug_s_m2_pa = p.moisture.transpiration_ug_s_m2_pa,
                                       .area_m2 = area * size * size,
                                       .surface_c = 30,
                                       .air_c = 30,
                                       .relative_humidity = 0.4});
    EXPECT_NEAR(1000 * volume * size * size * size / expected, 1, 1e-9);
}

TEST(Moisture, LedgerClosesAndStartsWithTheRightMass) {
    DryingParameters p = by_the_hour();
    p.moisture.sun_direction = {1, 1, 0};
    p.moisture.shades = {-1, 0, 0, 40, 0.1};
    const Fruit fruit(p);
    CourseState state = fruit.course.start();
    // 80 % water and 20 % of 1550 kg/m3
    const double volume = fruit.course.cells().volume() * std::pow(p.fruit.size_m, 3);
    EXPECT_NEAR(fruit.course.ledger(state).start_mass_kg(), volume / (0.8 / 1000 + 0.2 / 1550), 1e-9);
    double lost = 0;
    while (state.parameter < 60) {
        state = fruit.course.increment(state, 60, 0.01, nodes_of(fruit.mesh)).to;
        const water::WaterLedger ledger = fruit.course.ledger(state);
        EXPECT_LT(std::abs(ledger.error()), 1e-9);
        EXPECT_GT(ledger.lost_kg(), lost);
        lost = ledger.lost_kg();
    }
    EXPECT_GT(fruit.course.ledger(state).lost_fraction(), 0.5);
}

TEST(Moisture, WaterComesToRestWithTheAir) {
    // Raoult: the activity of what is left is the air's humidity.
    DryingParameters p = by_the_hour();
    p.moisture.transpiration_ug_s_m2_pa = 50;
    p.moisture.diffusivity_m2_s = 1e-8;
    const Fruit fruit(p);
    const CourseState state = fruit.at(2000);
    const double fresh = fruit.course.start().values.front();
    const double solutes = fresh * (1 / water::kSapVapourRatio - 1);
    EXPECT_NEAR(state.values.front(), solutes * 0.4 / (1 - 0.4), 1e-5);
    EXPECT_NEAR(state.shrinkage, p.drying.shrinkage, 1e-12) << "shrinks no further than asked";
}

TEST(Moisture, FastDiffusionIsOneShrinkageForAll) {
    DryingParameters p = by_the_hour();
    p.moisture.diffusivity_m2_s = 1e-3;
    p.moisture.sun_direction = {0, 1, 0};
    const Fruit fruit(p);
    const CourseState state = fruit.at(30);
    const std::vector<double> shrunk = fruit.course.shrinkages(state);
    const auto [least, most] = std::minmax_element(shrunk.begin(), shrunk.end());
    EXPECT_GT(*least, 0.1);
    EXPECT_LT(*most, p.drying.shrinkage);
    EXPECT_LT(*most - *least, 1e-5);
    // theta^3 is what is left of the volume
    const water::WaterLedger ledger = fruit.course.ledger(state);
    const double lost = ledger.lost_kg() / 1000 / std::pow(p.fruit.size_m, 3);
    EXPECT_NEAR(std::pow(1 - state.shrinkage, 3), 1 - lost / fruit.course.cells().volume(), 1e-8);
    const DryingField field = fruit.course.field(state);
    EXPECT_NEAR((field(3, 2) - (1 - state.shrinkage) * Eigen::Matrix3d::Identity()).norm(), 0, 1e-5);
    EXPECT_EQ((field(3, 7) - Eigen::Matrix3d::Identity()).norm(), 0) << "the skin does not shrink";
}

TEST(Moisture, OutsideDriesFirst) {
    const Fruit fruit(by_the_hour());
    const CourseState state = fruit.at(10);
    const std::size_t layers = fruit.course.cells().layers();
    for (std::size_t q = 0; q < fruit.course.cells().quads(); ++q)
        for (std::size_t k = 1; k < layers; ++k)
            EXPECT_LT(state.values[q * layers + k], state.values[q * layers + k - 1]);
}

TEST(Moisture, SunnySideDriesFirstAndShadedSideLast) {
    DryingParameters p = by_the_hour();
    p.moisture.sun_direction = {0, 0, 1};
    p.moisture.shades = {1, 0, 0, 45, 0.2};
    const Fruit fruit(p);
    for (const double hours : {2.0, 10.0, 25.0}) {
        const CourseState state = fruit.at(hours);
        const double sunny = fruit.moisture_near(state, Vec3::UnitZ());
        const double neither = fruit.moisture_near(state, -Vec3::UnitZ());
        const double shaded = fruit.moisture_near(state, Vec3::UnitX());
        EXPECT_LT(sunny, neither - 0.01);
        EXPECT_LT(neither, shaded - 0.01);
    }
}

TEST(Moisture, PaintScalesTranspiration) {
    const DryingParameters p = by_the_hour();
    const Fruit plain(p);
    const Fruit painted(p, [](const geometry::Vec2& uv) { return uv.x() < 0.5 ? 1.0 : 0.25; });
    const std::vector<double> areas = plain.course.cells().skin_areas(plain.mesh.nodes);
    const SkinEvaporation all = plain.course.evaporation_at(0, areas);
    const SkinEvaporation some = painted.course.evaporation_at(0, areas);
    const auto uvs = geometry::brick_atlas(plain.mesh.brick);
    int dark = 0;
    for (std::size_t q = 0; q < areas.size(); ++q) {
        const bool bright = uvs[q][0].x() + uvs[q][1].x() + uvs[q][2].x() + uvs[q][3].x() < 2;
        EXPECT_DOUBLE_EQ(some.leaving[q], (bright ? 1 : 0.25) * all.leaving[q]);
        dark += bright ? 0 : 1;
    }
    EXPECT_GT(dark, 0);
    EXPECT_LT(dark, static_cast<int>(areas.size()));
}

TEST(Moisture, NightStopsTheSun) {
    DryingParameters p = by_the_hour();
    p.moisture.sun_direction = {0, 1, 0};
    p.moisture.sunshine = Sunshine::Day;
    p.moisture.start_hour = 6;
    const Fruit fruit(p);
    const std::vector<double> areas = fruit.course.cells().skin_areas(fruit.mesh.nodes);
    const auto sum = [&](double hour) {
        double total = 0;
        for (const double leaving : fruit.course.evaporation_at(hour, areas).leaving) total += leaving;
        return total;
    };
    EXPECT_GT(sum(6), 1.05 * sum(2));
    EXPECT_GT(sum(2), 1.05 * sum(13));
    EXPECT_DOUBLE_EQ(sum(13), sum(20));
    EXPECT_DOUBLE_EQ(sum(6), sum(30));
}

TEST(Moisture, IncrementsStopAtTheAllowedChangeAndLeaveNothingBehind) {
    const Fruit fruit(by_the_hour());
    const CourseState start = fruit.at(3);
    const CourseState copy = start;
    const CourseIncrement large = fruit.course.increment(start, 100, 0.01, nodes_of(fruit.mesh));
    EXPECT_LE(large.change, 0.0103);
    EXPECT_GE(large.change, 0.008);
    EXPECT_FALSE(large.cut_at_target);
    const CourseIncrement small = fruit.course.increment(start, 100, 0.002, nodes_of(fruit.mesh));
    EXPECT_LE(small.change, 0.0021);
    EXPECT_LT(small.to.parameter, large.to.parameter);
    EXPECT_EQ(start.values, copy.values);
    EXPECT_EQ(fruit.course.increment(start, 100, 0.01, nodes_of(fruit.mesh)).to.values, large.to.values);
    const CourseIncrement cut =
        fruit.course.increment(start, start.parameter + 0.01, 0.01, nodes_of(fruit.mesh));
    EXPECT_TRUE(cut.cut_at_target);
    EXPECT_EQ(cut.to.parameter, start.parameter + 0.01);
}

TEST(Moisture, SameBitsForAnyThreadCount) {
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        results.push_back(Fruit(by_the_hour()).at(8).values);
    }
    EXPECT_EQ(results[0], results[1]);
}

TEST(Moisture, UnevenFactorsKeepTheVolume) {
    ShrinkageParameters factors;
    factors.radial = 0.5;
    factors.latitudinal = 1.4;
    const LayeredMesh mesh = flesh_ball(8, 4, kStone);
    const RecipeDrying drying(mesh, factors);
    for (const double ratio : {1.0, 0.9, 0.5, 0.3}) {
        const double shrinkage = drying.shrinkage_for(ratio);
        EXPECT_NEAR(drying.element(5, 0, shrinkage).determinant(), ratio, 1e-12);
    }
}

template <class Change>
std::string complaint(const Change& change) {
    DryingParameters p = by_the_hour();
    change(p);
    return message_of([&] { check(p); });
}

TEST(Moisture, WrongInputIsNamed) {
    EXPECT_EQ(complaint([](auto&) {}), "no error");
    EXPECT_THAT(complaint([](auto& p) { p.climate.humidity = 1.4; }), HasSubstr("140 %"));
    EXPECT_THAT(complaint([](auto& p) {
                    p.moisture.sun_direction = {1, 0};
                }),
                HasSubstr("moisture.sun_direction"));
    EXPECT_THAT(complaint([](auto& p) {
                    p.moisture.sun_direction = {0, 0, 0};
                }),
                HasSubstr("moisture.sun_direction"));
    EXPECT_THAT(complaint([](auto& p) { p.moisture.shades = {1, 0, 0}; }), HasSubstr("it has 3"));
    EXPECT_THAT(complaint([](auto& p) {
                    p.moisture.shades = {0, 0, 0, 30, 0.5};
                }),
                HasSubstr("moisture.shades"));
    EXPECT_THAT(complaint([](auto& p) { p.moisture.shades = {1, 0, 0, 200, 0.5}; }), HasSubstr("200"));
    EXPECT_THAT(complaint([](auto& p) { p.moisture.shades = {1, 0, 0, 30, -1}; }), HasSubstr("factor"));
    EXPECT_THAT(complaint([](auto& p) { p.output.hours = {120}; }), HasSubstr("output.hours"));
    EXPECT_THAT(complaint([](auto& p) { p.output.shrinkages = {0.1}; }), HasSubstr("output.shrinkages"));
    EXPECT_THAT(complaint([](auto& p) {
                    p.moisture.hours = 0;
                    p.output.hours = {1};
                }),
                HasSubstr("moisture.hours"));
    const auto& table = drying_parameters();
    for (const auto& [key, value] : {std::pair{"moisture.diffusivity_m2_s", 0.0},
                                     {"moisture.water", 0.0},
                                     {"moisture.water", 1.0},
                                     {"climate.humidity", 1.4},
                                     {"moisture.transpiration_ug_s_m2_pa", 0.0}})
        EXPECT_NE(table.find(key)->info.problem_with(value), "") << key;
}

TEST(Moisture, FramesAreTakenByTheHour) {
    DryingParameters p = by_the_hour();
    p.output.frames = 5;
    EXPECT_EQ(frame_parameters(p), (std::vector<double>{0, 25, 50, 75, 100}));
    p.output.hours = {10, 60};
    EXPECT_EQ(frame_parameters(p), (std::vector<double>{0, 10, 60, 100}));
    p = DryingParameters{};
    EXPECT_EQ(frame_parameters(p), frame_shrinkages(p));
}

}  // namespace
}  // namespace windfall::drying
