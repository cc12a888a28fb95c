#include "geometry/sphere_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "decay/tetrahedra.h"
#include "geometry/sphere_map_areas.h"
#include "geometry/sphere_map_interior.h"
#include "support/message_of.h"
#include "support/test_surfaces.h"

namespace windfall::geometry {
namespace {

/// A rod bent by 218 degrees: no point inside sees all of its surface.
SurfaceMesh hook_mesh() { return test::bent_rod(0.17, 0.019, 3.8, 64, 128); }

std::vector<test::NamedSurface> coarse_fruit() {
    return {{"potato", test::potato_mesh(48, 32)}, {"pepper", test::pepper_mesh(48, 32)},
            {"bean", test::bean_mesh(32, 48)},     {"pear", test::pear_mesh(48, 32)},
            {"banana", test::banana_mesh(32, 64)}, {"hook", hook_mesh()}};
}

std::vector<Vec3> spread_directions(int count) {
    std::vector<Vec3> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count, rho = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
        directions.emplace_back(rho * std::cos(angle), rho * std::sin(angle), z);
    }
    return directions;
}

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

TEST(SphereMap, IsOneToOneAndEven) {
    for (const auto& [name, mesh] : coarse_fruit()) {
        SCOPED_TRACE(name);
        const SphereMap map(mesh);
        double whole = 0;
        for (const Triangle& t : map.surface().triangles) {
            ASSERT_GT(sphere_orientation(map.directions(), t), 0);
            whole += solid_angle(map.directions()[t[0]], map.directions()[t[1]], map.directions()[t[2]]);
        }
        // Positive triangles that cover the sphere once.
        EXPECT_NEAR(whole, 4 * std::numbers::pi, 1e-9);
        const auto [least, most] = map.area_ratios();
        EXPECT_GT(least, 0.4);
        EXPECT_LT(most, 2.5);
    }
}

TEST(SphereMap, FindsThePlaceOfEveryDirection) {
    const SphereMap map(hook_mesh());
    std::vector<Vec3> directions = spread_directions(20000);
    for (int x = -2; x <= 2; ++x)  // axes, edges and corners of the cube among them
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
    for (const Vec3& d : map.directions()) directions.push_back(d);
    for (const Vec3& d : directions) {
        const SurfacePlace place = map.place(d);
        ASSERT_GE(place.weights.minCoeff(), 0);
        ASSERT_NEAR(place.weights.sum(), 1, 1e-12);
        ASSERT_LT((map.direction(place) - d.normalized()).norm(), 1e-9);
    }
}

TEST(SphereMap, GivesEveryVertexItsOwnPosition) {
    const SphereMap map(test::banana_mesh(32, 64));
    for (std::size_t v = 0; v < map.directions().size(); ++v)
        ASSERT_LT((map.point(map.directions()[v]) - map.surface().positions[v]).norm(), 1e-12);
}

TEST(SphereMap, GivesPlacesBack) {
    const SphereMap map(test::pepper_mesh(48, 32));
    for (std::size_t t = 0; t < map.surface().triangles.size(); ++t) {
        const SurfacePlace place{static_cast<std::int32_t>(t), Vec3(0.2, 0.5, 0.3)};
        ASSERT_LT((map.point(map.direction(place)) - map.point(place)).norm(), 1e-12);
    }
}

TEST(SphereMap, LeavesASphereAsItIs) {
    const SphereMap map(test::sphere_mesh());
    for (const Vec3& d : spread_directions(500)) {
        EXPECT_LT((map.point(d) / 0.04 - d).norm(), 0.01);
        EXPECT_LT((map.normal(d) - d).norm(), 0.02);
    }
}

TEST(SphereMap, SeamsAndVertexOrderDoNotMatter) {
    const SurfaceMesh mesh = test::pear_mesh(48, 32);
    const SphereMap whole(mesh), split(test::split_vertices(mesh));
    ASSERT_EQ(split.surface().positions.size(), mesh.positions.size());
    for (const Vec3& d : spread_directions(500))
        EXPECT_LT((whole.point(d) - split.point(d)).norm(), 0.02 * 0.04);
}

TEST(SphereMap, IsTheSameOnAnyNumberOfThreads) {
    const SurfaceMesh mesh = test::banana_mesh(32, 64);
    const SphereMap map(mesh);
    const auto directions = spread_directions(20000);
    std::vector<Vec3> together(directions.size());
    parallel_for_each(directions.size(), [&](std::size_t i) { together[i] = map.point(directions[i]); });
    const ThreadLimit one(1);
    const SphereMap again(mesh);
    for (std::size_t i = 0; i < directions.size(); ++i) ASSERT_EQ(again.point(directions[i]), together[i]);
}

TEST(SphereMap, RefusesARing) {
    SurfaceMesh ring;
    constexpr int kAround = 24, kAcross = 10;
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * j / kAcross;
            const double rho = 0.04 + 0.01 * std::cos(b);
            ring.positions.emplace_back(rho * std::cos(a), rho * std::sin(a), 0.01 * std::sin(b));
        }
    const auto v = [&](int i, int j) { return i % kAround * kAcross + j % kAcross; };
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j)
            ring.faces.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)});
    EXPECT_THAT(message_of([&] { const SphereMap map(ring); }), testing::HasSubstr("folds over near ("));
}

// ---- the interior ----

TEST(SphereInterior, RunsFromOnePointToTheSurface) {
    const SphereMap map(test::pepper_mesh(48, 32));
    const SphereInterior interior(map, 8);
    const Vec3 centre = interior.point(Vec3::UnitX(), 0);
    for (const Vec3& d : spread_directions(300)) {
        EXPECT_EQ(interior.point(d, 0), centre);
        EXPECT_LT((interior.point(d, 1) - map.point(d)).norm(), 1e-12);
        EXPECT_LT((interior.point(d, 0.5) - interior.point(d, 0.5001)).norm(), 1e-4);
    }
}

TEST(SphereInterior, KeepsTheFleshOfEveryFruitTheRightWayOut) {
    for (const auto& [name, mesh] : coarse_fruit()) {
        SCOPED_TRACE(name);
        const SphereMap map(mesh);
        const SphereInterior interior(map, 10);
        const auto surface = [&](const Vec3& d) { return map.point(d); };
        const auto inside = [&](const Vec3& d, double fraction) { return interior.point(d, fraction); };
        for (const int layers : {6, 8}) {
            const auto flesh = decay::make_flesh_mesh(surface, inside, 10, layers);
            // Of a coarse banana the least is anything from 0.001 to 0.06 of the mean: which of its vertices
            // is the furthest, and so the whole map, hangs on rounding.
            double least = 1;
            for (const auto& t : flesh.tetrahedra)
                least = std::min(least, decay::six_volume(flesh.nodes[t[0]], flesh.nodes[t[1]],
                                                          flesh.nodes[t[2]], flesh.nodes[t[3]]));
            EXPECT_GT(least, 0) << layers << " layers";
        }
    }
}

TEST(SphereInterior, IsNeededWhereTheCentreDoesNotSeeTheSurface) {
    const SphereMap map(hook_mesh());
    const auto surface = [&](const Vec3& d) { return map.point(d); };
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : map.surface().positions)
        centre += p / static_cast<double>(map.surface().positions.size());
    EXPECT_THROW(decay::make_flesh_mesh(surface, decay::towards_centre(surface, centre), 10, 6), InputError);
}

TEST(SphereInterior, RefusesCellsThatCannotBe) {
    const SphereMap map(test::sphere_mesh(24, 16));
    EXPECT_THROW(SphereInterior(map, 1), InputError);
    EXPECT_THROW(SphereInterior(map, 1000), InputError);
}

}  // namespace
}  // namespace windfall::geometry
