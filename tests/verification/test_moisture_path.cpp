// Whole ways by the hour: mechanics and water together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/parallel.h"
#include "drying/checkpoint.h"
#include "drying/drying_process.h"
#include "drying/imperfection.h"
#include "drying/moisture_course.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

using geometry::Vec3;

DryingParameters by_the_hour(int n) {
    DryingParameters p;
    p.mesh.n = n;
    p.fruit.skin_thickness = 0.1;
    p.moisture.hours = 40;
    p.moisture.transpiration_ug_s_m2_pa = 8;
    p.moisture.diffusivity_m2_s = 2e-10;
    p.moisture.sun_direction = {0, 0, 1};
    p.moisture.sun_warming_k = 15;
    p.moisture.sunshine = Sunshine::Always;
    p.climate.name = water::ClimateName::Constant;
    p.climate.temperature_c = 30;
    p.climate.humidity = 0.3;
    return p;
}

DryingPath fruit(const DryingParameters& p) {
    const auto shape = make_shape(p.fruit);
    geometry::LayeredMesh mesh = make_mesh(p, *shape);
    add_imperfection(mesh, p, {});
    auto course = std::make_unique<MoistureCourse>(mesh, p, skin_exposure(mesh, p.moisture, {}, {}));
    return {std::move(mesh), p, std::move(course)};
}

bool same_bits(const DryingPath& a, const DryingPath& b) {
    const AlignedArray<double>& x = a.state().displacements.front();
    const AlignedArray<double>& y = b.state().displacements.front();
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0 &&
           a.state().course.values == b.state().course.values;
}

TEST(MoisturePath, SameBitsForAnyThreadCountAndAfterResuming) {
    const DryingParameters p = by_the_hour(8);
    const auto whole = [&] {
        DryingPath path = fruit(p);
        path.advance(5, {});
        path.advance(12, {});
        return path;
    };
    const ThreadLimit one(1);
    const DryingPath straight = whole();
    ASSERT_GT(straight.shrinkage(), 0.05);
    {
        const ThreadLimit two(2);
        EXPECT_TRUE(same_bits(straight, whole()));
    }
    DryingPath first = fruit(p);
    first.advance(5, {});
    const auto bytes = to_bytes({first.state(), 1, 0});
    DryingPath second = fruit(p);
    const std::size_t values = second.state().course.values.size();
    EXPECT_THROW(checkpoint_from(bytes, second.elasticity().size(), values + 1), InputError);
    second.set_state(checkpoint_from(bytes, second.elasticity().size(), values).path);
    second.advance(12, {});
    EXPECT_TRUE(same_bits(straight, second));
}

TEST(MoisturePath, InfiniteDiffusivityIsTheGivenShrinkage) {
    // The same increments by the hour and by shrinkage, to the same places, before and after the wrinkles
    // come.
    DryingParameters p = by_the_hour(16);
    p.moisture.diffusivity_m2_s = 1e-3;
    p.solver.newton_tolerance = 1e-3;
    DryingPath hours = fruit(p);
    const auto shape = make_shape(p.fruit);
    geometry::LayeredMesh mesh = make_mesh(p, *shape);
    add_imperfection(mesh, p, {});
    DryingPath given(std::move(mesh), p);
    double apart = 0;
    hours.advance(30, {}, [&] {
        // One increment to there, as by the hour: past the bifurcation runs whose increments end at other
        // places go to patterns that differ by percents.
        PathState state = given.state();
        state.next_step = 1;
        given.set_state(std::move(state));
        given.advance(hours.shrinkage(), {});
        const std::vector<Vec3> a = hours.positions();
        const std::vector<Vec3> b = given.positions();
        for (std::size_t i = 0; i < a.size(); ++i) apart = std::max(apart, (a[i] - b[i]).norm());
    });
    EXPECT_GT(hours.shrinkage(), 0.15);
    ASSERT_GT(hours.onset(), 0) << "the test must pass the bifurcation to mean anything";
    const double depth = hours.state().history.back().depth_rms;
    const double given_depth = given.state().history.back().depth_rms;
    std::printf("apart %.2e r_1; onset %.5f, given %.5f; depth %.5f, given %.5f t_e\n", apart, hours.onset(),
                given.onset(), depth / p.fruit.skin_thickness, given_depth / p.fruit.skin_thickness);
    EXPECT_LT(apart, 1e-3 * p.fruit.skin_thickness);
    EXPECT_NEAR(hours.onset() / given.onset(), 1, 1e-4);
    EXPECT_NEAR(depth / given_depth, 1, 1e-3);
}

/// Keeps the frames.
class Keeper final : public take::FrameSink {
  public:
    void add_mesh(const take::TakeMesh& value) override { mesh = value; }
    void add_frame(const take::Frame& frame) override { frames.push_back(frame); }
    void save_checkpoint(std::span<const std::byte>) override {}
    void set_summary(const nlohmann::json&) override {}

    take::TakeMesh mesh;
    std::vector<take::Frame> frames;
};

TEST(MoisturePath, SunnySideWrinklesFirstAndTheLedgerCloses) {
    DryingParameters p = by_the_hour(16);
    p.output.hours = {10, 15, 20, 25};
    Keeper take;
    run(p, take, {});
    ASSERT_EQ(take.frames.size(), 6U);
    double sunny_at_first = 0;
    double shaded_at_first = 0;
    for (const take::Frame& frame : take.frames) {
        EXPECT_LT(std::abs(frame.scalars.at("ledger_error")), 1e-9);
        EXPECT_NEAR(
            frame.scalars.at("water_lost_g") + frame.scalars.at("water_left_g") +
                frame.scalars.at("solids_g"),
            take.frames.front().scalars.at("water_left_g") + take.frames.front().scalars.at("solids_g"),
            1e-9);
        const take::FrameMesh& skin = frame.meshes.front();
        const auto& depth = skin.find("depth")->values;
        double sums[2] = {0, 0};
        int counts[2] = {0, 0};
        for (std::size_t v = 0; v < depth.size(); ++v) {
            const double height = take.mesh.rest.positions[v].z();
            if (std::abs(height) < 0.5) continue;
            const int side = height > 0 ? 0 : 1;
            sums[side] += static_cast<double>(depth[v]) * static_cast<double>(depth[v]);
            ++counts[side];
        }
        const double sunny = std::sqrt(sums[0] / counts[0]) / p.fruit.skin_thickness;
        const double shaded = std::sqrt(sums[1] / counts[1]) / p.fruit.skin_thickness;
        std::printf("%5.1f h  shrinkage %.3f  depth/t_e sunny %.3f shaded %.3f\n", frame.scalars.at("hours"),
                    frame.scalars.at("shrinkage"), sunny, shaded);
        if (sunny_at_first == 0 && sunny > 0.2) {
            sunny_at_first = sunny;
            shaded_at_first = shaded;
        }
    }
    EXPECT_GT(sunny_at_first, 0.2);
    EXPECT_LT(shaded_at_first, 0.5 * sunny_at_first);
    EXPECT_NEAR(take.frames.back().scalars.at("hours"), 40, 1e-9);
    const auto& moisture = take.frames[1].meshes.front().find("moisture")->values;
    EXPECT_LT(*std::min_element(moisture.begin(), moisture.end()), 0.9F);
}

}  // namespace
}  // namespace windfall::drying
