#include "geometry/fruit_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geometry/layered_mesh.h"

namespace windfall::geometry {
namespace {

const std::array<double, 8> kOnes = {1, 1, 1, 1, 1, 1, 1, 1};

std::array<double, 8> ellipsoid(double b, double c) {
    std::array<double, 8> radii{};
    for (int i = 0; i < 7; ++i) {
        const double phi = -std::numbers::pi / 2 + i * std::numbers::pi / 6;
        radii[i] = 1 / std::hypot(std::sin(phi), std::cos(phi) / b);
    }
    radii[7] = c;
    return radii;
}

TEST(FruitShape, EqualRadiiMakeASphereToSplineAccuracy) {
    const TenNumberFruit fruit(kOnes, 0.4, 0.4);
    for (const Vec3& direction : brick_directions(make_brick_surface({8, 8, 8}), Vec3::Ones()))
        EXPECT_NEAR(fruit.flesh_radius(direction), 1, 5e-4);
    for (int i = 0; i < 7; ++i) {
        const double phi = -std::numbers::pi / 2 + i * std::numbers::pi / 6;
        EXPECT_NEAR((fruit.generatrix(phi) - Vec2(std::cos(phi), std::sin(phi))).norm(), 0, 1e-12);
    }
}

TEST(FruitShape, GeneratrixHasNoKinks) {
    // Differences from both sides of a knot agree up to curvature times the step.
    const TenNumberFruit fruit(ellipsoid(0.6, 0.6), 0.4, 0.2);
    constexpr double kStep = 1e-4;
    for (int i = 1; i < 6; ++i) {
        const double phi = -std::numbers::pi / 2 + i * std::numbers::pi / 6;
        const Vec2 left = (fruit.generatrix(phi) - fruit.generatrix(phi - kStep)) / kStep;
        const Vec2 right = (fruit.generatrix(phi + kStep) - fruit.generatrix(phi)) / kStep;
        EXPECT_NEAR((right - left).norm(), 0, 5 * kStep);
    }
}

TEST(FruitShape, EllipticEquatorHasItsHalfAxes) {
    const TenNumberFruit plum(ellipsoid(0.9, 0.7), 0.4, 0.3);
    EXPECT_NEAR(plum.flesh_radius(Vec3::UnitX()), 0.9, 1e-9);
    EXPECT_NEAR(plum.flesh_radius(-Vec3::UnitX()), 0.9, 1e-9);
    EXPECT_NEAR(plum.flesh_radius(Vec3::UnitZ()), 0.7, 1e-9);
    EXPECT_NEAR(plum.flesh_radius(Vec3::UnitY()), 1, 1e-9);
    EXPECT_NEAR(plum.stone_radius(Vec3::UnitY()), 0.4, 1e-12);
    EXPECT_NEAR(plum.stone_radius(Vec3::UnitX()), 0.3, 1e-12);
    EXPECT_NEAR(plum.stone_radius(Vec3::UnitZ()), 0.3 * 0.7 / 0.9, 1e-12);
    EXPECT_NEAR(plum.half_extents().z(), 0.7, 1e-3);
}

TEST(FruitShape, PolesAreSmooth) {
    const TenNumberFruit fruit(ellipsoid(0.6, 0.6), 0.4, 0.2);
    const double near = fruit.flesh_radius(Vec3(1e-3, 1, 0).normalized());
    EXPECT_NEAR(near, fruit.flesh_radius(Vec3::UnitY()), 1e-5);
}

TEST(FruitShape, StoneMayNotPierceTheFlesh) {
    EXPECT_THROW(TenNumberFruit(kOnes, 1.1, 0.4), InputError);
    EXPECT_THROW(TenNumberFruit(kOnes, 0.4, 1.0), InputError);
    EXPECT_NO_THROW(TenNumberFruit(kOnes, 0.9, 0.9));
}

TEST(FruitShape, FoldedOutlinesAreRefusedWithTheirPlace) {
    auto radii = kOnes;
    radii[2] = 6;
    try {
        const TenNumberFruit fruit(radii, 0.1, 0.1);
        FAIL() << "a folded outline was taken";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("degrees of latitude"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("fruit.r2"), std::string::npos);
    }
}

}  // namespace
}  // namespace windfall::geometry
