#include "geometry/brick_surface.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/error.h"

namespace windfall::geometry {
namespace {

class Bricks : public testing::TestWithParam<Lattice> {};

TEST_P(Bricks, SurfaceIsClosedAndConsistentlyOriented) {
    const BrickSurface brick = make_brick_surface(GetParam());
    std::map<std::pair<int, int>, int> directed;
    for (const Quad& quad : brick.quads)
        for (int c = 0; c < 4; ++c) ++directed[{quad[c], quad[(c + 1) % 4]}];
    for (const auto& [edge, count] : directed) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ(directed.count({edge.second, edge.first}), 1U);
    }
    // Euler: V - E + F = 2
    EXPECT_EQ(static_cast<int>(brick.vertex_count()) - static_cast<int>(directed.size() / 2) +
                  static_cast<int>(brick.quads.size()),
              2);
    std::vector<Vec3> positions;
    for (const Lattice& point : brick.lattice) positions.emplace_back(point[0], point[1], point[2]);
    const std::vector<Face> faces(brick.quads.begin(), brick.quads.end());
    const double cells = static_cast<double>(GetParam()[0]) * GetParam()[1] * GetParam()[2];
    EXPECT_NEAR(enclosed_volume(positions, faces), cells, 1e-9 * cells);
}

TEST_P(Bricks, VerticesAreFoundByTheirLatticePoint) {
    const BrickSurface brick = make_brick_surface(GetParam());
    for (std::size_t v = 0; v < brick.vertex_count(); ++v)
        ASSERT_EQ(brick.vertex_at(brick.lattice[v]), static_cast<int>(v));
    EXPECT_EQ(brick.vertex_at({-1, 0, 0}), -1);
    if (GetParam()[0] > 1 && GetParam()[1] > 1 && GetParam()[2] > 1) {
        EXPECT_EQ(brick.vertex_at({1, 1, 1}), -1);
    }
}

TEST_P(Bricks, AtlasChartsLieInTheUnitSquareWithoutOverlap) {
    const BrickSurface brick = make_brick_surface(GetParam());
    const auto uvs = brick_atlas(brick);
    ASSERT_EQ(uvs.size(), brick.quads.size());
    double area = 0;
    for (const auto& corners : uvs) {
        for (const Vec2& uv : corners) {
            ASSERT_GE(uv.minCoeff(), 0);
            ASSERT_LE(uv.maxCoeff(), 1);
        }
        const Vec2 a = corners[2] - corners[0];
        const Vec2 b = corners[3] - corners[1];
        const double own = 0.5 * (a.x() * b.y() - a.y() * b.x());
        ASSERT_GT(own, 0);
        area += own;
    }
    EXPECT_LT(area, 1);
    // Charts are rectangles in cells of a grid: no two quads share their middle.
    std::set<std::pair<long, long>> middles;
    for (const auto& corners : uvs) {
        const Vec2 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
        EXPECT_TRUE(middles.insert({std::lround(middle.x() * 1e6), std::lround(middle.y() * 1e6)}).second);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Bricks,
                         testing::Values(Lattice{1, 1, 1}, Lattice{8, 8, 8}, Lattice{4, 12, 6}));

TEST(Brick, RejectsABrickWithoutCells) { EXPECT_THROW(make_brick_surface({4, 0, 4}), InputError); }

TEST(Brick, ParentsReproduceLinearFunctionsOnEverySide) {
    const BrickSurface fine = make_brick_surface({8, 16, 8});
    const BrickSurface coarse = make_brick_surface(coarser(fine.cells));
    const auto parents = brick_parents(fine, coarse);
    for (std::size_t v = 0; v < fine.vertex_count(); ++v) {
        ASSERT_GE(parents[v].count, 1);
        for (int axis = 0; axis < 3; ++axis) {
            double value = 0;
            for (int p = 0; p < parents[v].count; ++p)
                value += 2.0 * coarse.lattice[parents[v].vertex[p]][axis] / parents[v].count;
            ASSERT_NEAR(value, fine.lattice[v][axis], 1e-12);
        }
    }
}

TEST(Brick, CoarsensWhileAllSidesAreEvenAndLarge) {
    EXPECT_TRUE(can_coarsen({8, 24, 8}));
    EXPECT_FALSE(can_coarsen({6, 9, 6}));
    EXPECT_FALSE(can_coarsen({2, 8, 2}));
}

}  // namespace
}  // namespace windfall::geometry
