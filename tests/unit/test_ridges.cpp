#include "drying/ridges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/layered_mesh.h"
#include "geometry/smooth_surface.h"

namespace windfall::drying {
namespace {

using geometry::Vec3;

struct Sphere {
    geometry::BrickSurface brick = geometry::make_brick_surface({48, 48, 48});
    std::vector<Vec3> rest = geometry::brick_directions(brick, Vec3::Ones());
    std::vector<geometry::Face> faces{brick.quads.begin(), brick.quads.end()};

    template <class F>
    std::vector<double> field(F f) const {
        std::vector<double> values;
        for (const Vec3& p : rest) values.push_back(f(p));
        return values;
    }
};

TEST(Ridges, RidgesAlongMeridiansAlignPositively) {
    const Sphere sphere;
    const auto along = sphere.field([](const Vec3& p) {
        const double rho = std::hypot(p.x(), p.z());
        return rho * rho * std::cos(9 * std::atan2(p.z(), p.x()));
    });
    const auto across = sphere.field([](const Vec3& p) { return std::cos(14 * std::asin(p.y())); });
    EXPECT_GT(measure_ridges(sphere.rest, sphere.faces, along).meridian_alignment, 0.8);
    EXPECT_LT(measure_ridges(sphere.rest, sphere.faces, across).meridian_alignment, -0.99);
}

TEST(Ridges, WaveLengthOfAHarmonicIsThatOfItsDegree) {
    // A spherical harmonic of degree l has the mean square wave number l (l + 1).
    const Sphere sphere;
    const auto harmonic = sphere.field([](const Vec3& p) {
        return std::pow(std::hypot(p.x(), p.z()), 8) * std::cos(8 * std::atan2(p.z(), p.x()));
    });
    const RidgeMeasures measures = measure_ridges(sphere.rest, sphere.faces, harmonic);
    const double expected = 2 * std::numbers::pi / std::sqrt(8.0 * 9);
    EXPECT_NEAR(measures.wavelength, expected, 0.02 * expected);
}

TEST(Ridges, DepthIsTheRootMeanSquareOverTheArea) {
    const Sphere sphere;
    const auto linear = sphere.field([](const Vec3& p) { return 0.3 * p.x() + 7; });
    EXPECT_NEAR(measure_ridges(sphere.rest, sphere.faces, linear).depth_rms, 0.3 / std::sqrt(3.0), 1e-3);
}

TEST(Ridges, ValleysAreCountedOnce) {
    const Sphere sphere;
    // Dents about the six axis points, then the same with two of them joined.
    const auto dents = [&](bool joined) {
        return sphere.field([joined](const Vec3& p) {
            double depth = 0;
            for (int axis = 0; axis < 3; ++axis)
                for (const double sign : {-1.0, 1.0})
                    depth += std::exp(-40 * (p - sign * Vec3::Unit(axis)).squaredNorm());
            if (joined && p.x() > 0 && p.y() > 0) depth = std::max(depth, std::exp(-40 * p.z() * p.z()));
            return depth;
        });
    };
    EXPECT_EQ(measure_ridges(sphere.rest, sphere.faces, dents(false)).valleys, 6);
    EXPECT_EQ(measure_ridges(sphere.rest, sphere.faces, dents(true)).valleys, 5);
}

TEST(Ridges, LatitudeBandsSeeOnlyTheirOwn) {
    const Sphere sphere;
    const auto equator = sphere.field([](const Vec3& p) {
        return std::abs(std::asin(p.y())) < 0.2 ? std::cos(20 * std::atan2(p.z(), p.x())) : 0.0;
    });
    const auto bands = measure_ridges(sphere.rest, sphere.faces, equator).depth_rms_by_latitude;
    ASSERT_EQ(bands.size(), static_cast<std::size_t>(kLatitudeBands));
    EXPECT_LT(bands.front(), 0.05);
    EXPECT_LT(bands.back(), 0.05);
    EXPECT_GT(bands[6], 0.4);
}

TEST(Ridges, AFlatFieldHasNoRidges) {
    const Sphere sphere;
    const RidgeMeasures measures =
        measure_ridges(sphere.rest, sphere.faces, sphere.field([](const Vec3&) { return 2; }));
    EXPECT_NEAR(measures.depth_rms, 0, 1e-12);
    EXPECT_EQ(measures.valleys, 0);
}

TEST(SmoothSurface, ShrinkingAndBendingAreNoWrinkles) {
    const Sphere sphere;
    const auto areas = geometry::vertex_areas(sphere.rest, sphere.faces);
    const geometry::SlowField slow(sphere.rest, areas);
    std::vector<Vec3> bent;
    for (const Vec3& p : sphere.rest)
        bent.emplace_back(0.6 * p.x(), 0.8 * p.y() + 0.1 * p.x() * p.x(), 0.7 * p.z());
    for (const double depth : geometry::depth_below_smooth_surface(slow, sphere.rest, bent, sphere.faces))
        ASSERT_NEAR(depth, 0, 1e-9);
}

TEST(SmoothSurface, WrinklesOnAShrunkenSphereAreFoundWhole) {
    const Sphere sphere;
    const auto areas = geometry::vertex_areas(sphere.rest, sphere.faces);
    const geometry::SlowField slow(sphere.rest, areas);
    const auto depth = sphere.field([](const Vec3& p) {
        return 0.02 * std::pow(std::hypot(p.x(), p.z()), 12) * std::cos(12 * std::atan2(p.z(), p.x()));
    });
    std::vector<Vec3> wrinkled;
    for (std::size_t v = 0; v < depth.size(); ++v) wrinkled.emplace_back((0.7 - depth[v]) * sphere.rest[v]);
    const auto found = geometry::depth_below_smooth_surface(slow, sphere.rest, wrinkled, sphere.faces);
    for (std::size_t v = 0; v < depth.size(); ++v) ASSERT_NEAR(found[v], depth[v], 2e-4);
}

}  // namespace
}  // namespace windfall::drying
