#include "geometry/laid_brick.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/layered_mesh.h"
#include "geometry/medial_radius.h"
#include "support/test_surfaces.h"

namespace windfall::geometry {
namespace {

/// A cube of 2 x 2 x 2 whose sides have `cells` x `cells` quadrilaterals.
SurfaceMesh cube(int cells) {
    SurfaceMesh mesh;
    const BrickSurface brick = make_brick_surface({cells, cells, cells});
    for (const Lattice& p : brick.lattice)
        mesh.positions.emplace_back(2.0 / cells * Vec3(p[0], p[1], p[2]) - Vec3::Ones());
    mesh.faces.assign(brick.quads.begin(), brick.quads.end());
    return mesh;
}

TEST(CurvedSurface, FacetsOfABallAreRoundedAway) {
    constexpr double kRadius = 0.04;
    const CurvedSurface ball(welded_triangles(test::sphere_mesh(32, 20, kRadius)));
    double facets = 0, curved = 0;
    for (std::size_t t = 0; t < ball.triangles().triangles.size(); ++t) {
        const SurfacePlace middle{static_cast<std::int32_t>(t), Vec3::Constant(1.0 / 3)};
        const Vec3 flat = at_place(ball.triangles().positions, ball.triangles().triangles, middle);
        facets = std::max(facets, std::abs(flat.norm() - kRadius));
        curved = std::max(curved, std::abs(ball.at(middle).point.norm() - kRadius));
    }
    EXPECT_GT(facets, 1e-4);
    EXPECT_LT(curved, 0.15 * facets);
}

TEST(CurvedSurface, CreasesStayAndVerticesToo) {
    const CurvedSurface box(welded_triangles(cube(2)));
    for (std::size_t t = 0; t < box.triangles().triangles.size(); ++t)
        for (const Vec3& weights : {Vec3(0.5, 0.3, 0.2), Vec3(1, 0, 0)}) {
            const SurfacePlace place{static_cast<std::int32_t>(t), weights};
            const Vec3 flat = at_place(box.triangles().positions, box.triangles().triangles, place);
            EXPECT_LT((box.at(place).point - flat).norm(), 1e-12);
        }
}

TEST(MedialRadius, IsABallsOwnAndHalfASlabsThickness) {
    const CurvedSurface ball(welded_triangles(test::sphere_mesh(64, 48, 0.04)));
    EXPECT_NEAR(medial_radius(ball.tree(), {0.04, 0, 0}, {1, 0, 0}, 1, 0.001), 0.04, 0.0004);
    SurfaceMesh slab = cube(12);
    for (Vec3& p : slab.positions) p.z() *= 0.1;
    const CurvedSurface flat(welded_triangles(slab));
    EXPECT_NEAR(medial_radius(flat.tree(), {0.02, 0.03, 0.1}, {0, 0, 1}, 3, 0.01), 0.1, 1e-9);
    // At most what is asked for.
    EXPECT_EQ(medial_radius(flat.tree(), {0.02, 0.03, 0.1}, {0, 0, 1}, 0.05, 0.01), 0.05);
}

TEST(LaidBrick, LongFruitGetLongBricks) {
    const auto length_of = [](const SurfaceMesh& mesh) {
        const SphereMap map(mesh);
        return best_elongation(CurvedSurface(map.surface()), map);
    };
    EXPECT_EQ(length_of(test::sphere_mesh(32, 24)), 1);
    EXPECT_GE(length_of(test::bean_mesh(24, 32)), 1.5);
}

TEST(LaidBrick, IsTheSameOnAnyNumberOfThreads) {
    const SphereMap map(test::bean_mesh(32, 48));
    const CurvedSurface surface(map.surface());
    const auto laid_with = [&](int threads) {
        const ThreadLimit limit(threads);
        return lay_brick(surface, map, {8, 16, 8}).positions();
    };
    EXPECT_EQ(laid_with(1), laid_with(2));
}

}  // namespace
}  // namespace windfall::geometry
