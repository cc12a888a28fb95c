// The way down again: without plastic set a fruit swells back to what it was, with it wrinkles stay.
#include <gtest/gtest.h>

#include <cstring>

#include "drying/checkpoint.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

constexpr double kMost = 0.15, kThereAndBack = 2 * kMost;

DryingPath coarse_fruit(double flesh_yield_strain, double most = kMost) {
    DryingParameters p;
    p.fruit.skin_thickness = 0.08;
    p.mesh.n = 16;
    p.drying.shrinkage = most;
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
    EXPECT_EQ(path.shrinkage(), kMost);
    path.advance(kThereAndBack, {});
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
    path.advance(kThereAndBack, {});
    EXPECT_GT(depth_over_te(path), 0.25 * dried);
    EXPECT_LT(depth_over_te(path), dried);
}

TEST(Rewetting, ResumesToTheSameBits) {
    constexpr double kLess = 0.06;
    DryingPath straight = coarse_fruit(0.05, kLess);
    straight.advance(1.5 * kLess, {});
    const auto bytes = to_bytes({straight.state(), 2, 1});
    straight.advance(2 * kLess, {});

    DryingPath resumed = coarse_fruit(0.05, kLess);
    Checkpoint checkpoint = checkpoint_from(bytes, resumed.elasticity().size(), 0);
    EXPECT_FALSE(checkpoint.path.set.empty());
    resumed.set_state(std::move(checkpoint.path));
    resumed.advance(2 * kLess, {});
    const auto& a = straight.state().displacements.front();
    const auto& b = resumed.state().displacements.front();
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
    EXPECT_EQ(straight.state().set, resumed.state().set);
}

}  // namespace
}  // namespace windfall::drying
