#include "fracture/tree_branch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fracture/tree_section.h"
#include "support/message_of.h"
#include "support/test_trees.h"

namespace windfall::fracture {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using ::testing::HasSubstr;

TreeSurface surface_of(const test::TestTree& tree) { return make_tree_surface(test::as_mesh(tree, true)); }

test::Tube straight_tube(const Vec3& axis, double a, double b) {
    test::Tube tube;
    tube.centre = [=](double t) { return Vec3(axis * t); };
    tube.half_axes = [=](double) { return Vec2(a, b); };
    tube.sides = 64;
    return tube;
}

std::vector<std::int32_t> all_triangles(const TreeSurface& surface) {
    std::vector<std::int32_t> all(surface.triangles.size());
    for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<std::int32_t>(t);
    return all;
}

TEST(TreeSurface, SplitVerticesAreWeldedAndNeighboursFound) {
    const meshfile::Mesh mesh = test::as_mesh(test::tube_tree(straight_tube({0, 2, 0}, 0.1, 0.1)), true);
    const TreeSurface surface = make_tree_surface(mesh);
    EXPECT_EQ(surface.positions.size(), 25U * 64U + 2U);
    EXPECT_GT(mesh.positions.size(), surface.positions.size());  // split at the seam and at the moss
    EXPECT_EQ(surface.components, 1);
    for (const auto& neighbours : surface.neighbours)
        for (const std::int32_t n : neighbours) EXPECT_GE(n, 0);
}

TEST(TreeSurface, NearestPlaceOfATriangleInAllItsZones) {
    meshfile::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    mesh.corners = {0, 1, 2};
    mesh.face_starts = {0, 3};
    mesh.faces = {{}};
    mesh.groups = {{}};
    const TreeSurface surface = make_tree_surface(mesh);
    const std::vector<std::pair<Vec3, Vec3>> cases{{{0.5, 0.5, 3}, {0.5, 0.5, 0}}, {{-1, -1, 1}, {0, 0, 0}},
                                                   {{3, -1, 0}, {2, 0, 0}},        {{-1, 4, 0}, {0, 2, 0}},
                                                   {{1, -2, 1}, {1, 0, 0}},        {{-2, 1, 1}, {0, 1, 0}},
                                                   {{2, 2, 5}, {1, 1, 0}}};
    for (const auto& [point, nearest] : cases)
        EXPECT_NEAR((nearest_place(surface, point).position - nearest).norm(), 0, 1e-12);
}

TEST(TreeSection, AreaAndCentroidOfAnEllipse) {
    const TreeSurface surface = surface_of(test::tube_tree(straight_tube({0, 2, 0}, 0.2, 0.1)));
    SectionTracer tracer(surface);
    const auto sections = tracer.cut(all_triangles(surface), {0.05, 0.77, 0.02}, Vec3::UnitY());
    ASSERT_EQ(sections.size(), 1U);
    const Section& section = sections[0];
    EXPECT_TRUE(section.closed);
    // A polygon of n corners on an ellipse takes n / (2 pi) sin(2 pi / n) of it.
    const double share = 64 / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi / 64);
    EXPECT_NEAR(section.area, share * std::numbers::pi * 0.2 * 0.1, 1e-9);
    EXPECT_NEAR((section.centroid - Vec3(0, 0.77, 0)).norm(), 0, 1e-9);
    EXPECT_TRUE(section.encloses({0.1, 0.77, 0}));
    EXPECT_FALSE(section.encloses({0.1, 0.77, 0.15}));
    EXPECT_NEAR(section.outer_radius(section.centroid), 0.2, 1e-8);  // crossings are single precision
    EXPECT_NEAR(section.distance(section.centroid), 0.1, 1e-3);
}

TEST(TreeSection, LoopsOfTwoBranchesAreTwo) {
    const TreeSurface surface = surface_of(test::forked_tree(test::fork_limbs(), 0.04));
    SectionTracer tracer(surface);
    EXPECT_EQ(tracer.cut(all_triangles(surface), {0, 1, 0}, Vec3::UnitY()).size(), 1U);
    EXPECT_EQ(tracer.cut(all_triangles(surface), {0, 2.7, 0}, Vec3::UnitY()).size(), 2U);
    EXPECT_EQ(tracer.cut(all_triangles(surface), {0, 9, 0}, Vec3::UnitY()).size(), 0U);
}

TEST(TreeBranch, AxisAndRadiusOfATubeInAnyDirection) {
    for (const Vec3& axis : {Vec3(0, 2, 0), Vec3(1, 1, 1), Vec3(-1.5, 0.2, 0.4), Vec3(0, 0, -2)})
        for (const double b : {0.1, 0.05}) {
            const TreeSurface surface = surface_of(test::tube_tree(straight_tube(axis, 0.1, b)));
            SectionTracer tracer(surface);
            const TreeBranch branch = find_branch(surface, tracer, 0.5 * axis + 0.09 * axis.unitOrthogonal());
            EXPECT_NEAR(std::abs(branch.axis.dot(axis.normalized())), 1, 1e-6);
            EXPECT_NEAR(branch.radius, std::sqrt(0.1 * b), 2e-4);
            EXPECT_NEAR(branch.centre.cross(axis.normalized()).norm(), 0, 1e-5);
        }
}

TEST(TreeBranch, FollowsAnArc) {
    constexpr double kBend = 2;  // radius of the arc
    test::Tube tube;
    tube.centre = [](double t) { return Vec3(kBend * (1 - std::cos(t)), kBend * std::sin(t), 0); };
    tube.half_axes = [](double) { return Vec2(0.1, 0.1); };
    tube.rings = 60;
    const TreeSurface surface = surface_of(test::tube_tree(tube));
    SectionTracer tracer(surface);
    TreeBranch branch = find_branch(surface, tracer, tube.centre(0.5) + Vec3(0, 0, 0.1));
    if (branch.axis.y() < 0) branch.axis = -branch.axis;
    const BranchAxis axis = follow_branch(surface, tracer, branch, 0.6, Vec3::UnitZ());
    EXPECT_LE(axis.lowest(), -0.6);
    EXPECT_GE(axis.highest(), 0.6);
    for (double height = -0.6; height <= 0.6; height += 0.05) {
        const AxisFrame frame = axis.at(height);
        const double t = 0.5 + height / kBend;
        EXPECT_NEAR((frame.centre - tube.centre(t)).norm(), 0, 0.01) << height;
        EXPECT_NEAR(frame.along.dot(Vec3(std::sin(t), std::cos(t), 0)), 1, 2e-3);
        // In a plane arc frames that do not turn keep the normal of the plane.
        EXPECT_NEAR(frame.across.z(), 1, 1e-2);
        EXPECT_NEAR(frame.across.dot(frame.along), 0, 1e-12);
        EXPECT_NEAR(axis.height_of(frame.centre + 0.05 * frame.direction(1)), height, 1e-6);
    }
}

TEST(TreeBranch, AnglesCountFromTheUpperSide) {
    const TreeSurface surface = surface_of(test::tube_tree(straight_tube({3, 0.5, 0}, 0.1, 0.1)));
    SectionTracer tracer(surface);
    const TreeBranch branch = find_branch(surface, tracer, {1.5, 0.35, 0});
    const BranchAxis axis = follow_branch(surface, tracer, branch, 0.5, Vec3::UnitY());
    EXPECT_GT(axis.at(0).direction(0).y(), 0.98);
}

TEST(TreeBranch, RefusesToFollowThroughForkEndAndSharpBend) {
    const TreeSurface fork = surface_of(test::forked_tree(test::fork_limbs(), 0.04));
    SectionTracer tracer(fork);
    const TreeBranch branch = find_branch(fork, tracer, {0.36, 2.6, 0});
    EXPECT_NO_THROW(follow_branch(fork, tracer, branch, 0.3, Vec3::UnitY()));
    const std::string at_fork = message_of([&] { follow_branch(fork, tracer, branch, 0.8, Vec3::UnitY()); });
    EXPECT_THAT(at_fork, HasSubstr("forks"));
    EXPECT_THAT(at_fork, HasSubstr("pick a point"));
    const std::string at_both_ends =
        message_of([&] { follow_branch(fork, tracer, branch, 5, Vec3::UnitY()); });
    EXPECT_THAT(at_both_ends, HasSubstr("lower the break"));

    test::Tube tube;  // as thick as its arc allows
    tube.centre = [](double t) { return Vec3(0.15 * (1 - std::cos(3 * t)), 0.15 * std::sin(3 * t), 0); };
    tube.half_axes = [](double) { return Vec2(0.13, 0.13); };
    tube.rings = 60;
    tube.sides = 40;
    const TreeSurface sharp = surface_of(test::tube_tree(tube));
    SectionTracer sharp_tracer(sharp);
    const TreeBranch bent = find_branch(sharp, sharp_tracer, tube.centre(0.5) + Vec3(0, 0, 0.13));
    EXPECT_THAT(message_of([&] { follow_branch(sharp, sharp_tracer, bent, 0.1, Vec3::UnitY()); }),
                HasSubstr("bends too sharply"));
}

}  // namespace
}  // namespace windfall::fracture
