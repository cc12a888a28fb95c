// The way down again: without plastic set a fruit swells back to what it was, with it wrinkles stay.
#include <gtest/gtest.h>

#include <cstring>

#include "drying/checkpoint.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

constexpr double kMost = 0.15;

DryingPath coarse_fruit(double flesh_yield_strain) {
    DryingParameters p;
    p.fruit.skin_thickness = 0.08;
    p.mesh.n = 16;
    p.drying.shrinkage = kMost;
    p.drying.rewet = 1;
    p.plastic.flesh_yield_strain = flesh_yield_strain;
    geometry::LayeredMesh mesh = make_mesh(p, *make_shape(p.fruit));
    add_imperfection(mesh, p, {});
    return {std::move(mesh), p};
}

double depth_over_te(const DryingPath& path) { return path.state().history.back().depth_rms / 0.08; }

TEST(Rewetting, WithoutSetTheFruitIsSmoothAgain) {
    DryingPath path = coarse_fruit(0);
    path.advance(kMost, {});
    ASSERT_GT(depth_over_te(path), 0.5);
    EXPECT_FALSE(path.rewetting());
    path.advance(0, {});
    EXPECT_TRUE(path.rewetting());
    EXPECT_EQ(path.shrinkage(), 0);
    EXPECT_LT(depth_over_te(path), 0.01);
    double furthest = 0;
    for (const double u : path.state().displacements.front()) furthest = std::max(furthest, std::abs(u));
    EXPECT_LT(furthest, 0.005);
    EXPECT_TRUE(path.state().set.empty());
}

TEST(Rewetting, WithSetWrinklesStay) {
    DryingPath path = coarse_fruit(0.15);
    path.advance(kMost, {});
    const double dried = depth_over_te(path);
    ASSERT_GT(dried, 0.5);
    path.advance(0, {});
    EXPECT_GT(depth_over_te(path), 0.25 * dried);
    EXPECT_LT(depth_over_te(path), dried);
}

TEST(Rewetting, ResumesToTheSameBits) {
    DryingPath straight = coarse_fruit(0.05);
    straight.advance(0.06, {});
    straight.advance(0.03, {});
    const auto bytes = to_bytes({straight.state(), 2, 1});
    straight.advance(0, {});

    DryingPath resumed = coarse_fruit(0.05);
    Checkpoint checkpoint = checkpoint_from(bytes, resumed.elasticity().size());
    EXPECT_FALSE(checkpoint.path.set.empty());
    resumed.set_state(std::move(checkpoint.path));
    resumed.advance(0, {});
    const auto& a = straight.state().displacements.front();
    const auto& b = resumed.state().displacements.front();
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
    EXPECT_EQ(straight.state().set, resumed.state().set);
}

}  // namespace
}  // namespace windfall::drying
