#include "geometry/surface_transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/layered_mesh.h"
#include "geometry/sphere_map.h"
#include "support/message_of.h"
#include "support/test_surfaces.h"

namespace windfall::geometry {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Thickness of the skin's effective layer on fruit of about 40 mm: the length that errors are told in.
constexpr double kThickness_m = 0.04 * 0.04;

/// A cube's surface laid on an artist's mesh by its map.
struct Skin {
    BrickSurface brick;
    Points rest;

    Skin(const SphereMap& map, int cells) : brick(make_brick_surface({cells, cells, cells})) {
        for (const Vec3& d : brick_directions(brick, Vec3::Ones()))
            rest.push_back(map.point(d).cast<float>());
    }
    Points moved(const std::function<Vec3(const Vec3&)>& motion) const {
        Points result;
        for (const auto& p : rest) result.push_back(motion(p.cast<double>()).cast<float>());
        return result;
    }
};

double largest_error(const Points& points, const std::vector<Vec3>& expected) {
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        largest = std::max(largest, (points[i].cast<double>() - expected[i]).norm());
    return largest;
}

std::vector<Vec3> mapped(const std::vector<Vec3>& points, const std::function<Vec3(const Vec3&)>& motion) {
    std::vector<Vec3> result;
    for (const Vec3& p : points) result.push_back(motion(p));
    return result;
}

/// Shrinks by a quarter, unevenly, and twists by half a radian over the fruit's height.
Vec3 withered(const Vec3& p) {
    const Vec3 small(0.75 * p.x(), 0.8 * p.y(), 0.7 * p.z());
    return Eigen::AngleAxisd(6 * small.z(), Vec3::UnitZ()) * small;
}

TEST(SurfaceTransfer, RestGivesTheArtistsVerticesBack) {
    for (const auto& [name, mesh] : test::fruit_meshes()) {
        const Skin skin(SphereMap(mesh), 41);
        const SurfaceTransfer transfer(mesh.positions, vertex_normals(mesh.positions, mesh.faces), skin.rest,
                                       skin.brick.quads);
        EXPECT_LT(largest_error(transfer.moved(skin.rest), mesh.positions), 1e-6 * 0.04) << name;
        EXPECT_LT(transfer.largest_offset_m(), 0.002) << name;
    }
}

TEST(SurfaceTransfer, FollowsTurnsShiftsAndEvenShrinkage) {
    const SurfaceMesh mesh = test::pear_mesh();
    const Skin skin(SphereMap(mesh), 24);
    const SurfaceTransfer transfer(mesh.positions, vertex_normals(mesh.positions, mesh.faces), skin.rest,
                                   skin.brick.quads);
    const Eigen::AngleAxisd turn(1.2, Vec3(1, 2, -0.5).normalized());
    const auto motion = [&](const Vec3& p) -> Vec3 { return 0.7 * (turn * p) + Vec3(0.02, -0.01, 0.05); };
    EXPECT_LT(largest_error(transfer.moved(skin.moved(motion)), mapped(mesh.positions, motion)), 3e-8);
}

TEST(SurfaceTransfer, FollowsASmoothDeformationToAHundredthOfTheSkin) {
    for (const auto& [name, mesh] : test::fruit_meshes()) {
        // The bean is smaller than the rest, and its skin thinner.
        const double thickness_m = name == "bean" ? kThickness_m / 4 : kThickness_m;
        const Skin skin(SphereMap(mesh), 41);
        const SurfaceTransfer transfer(mesh.positions, vertex_normals(mesh.positions, mesh.faces), skin.rest,
                                       skin.brick.quads);
        EXPECT_LT(largest_error(transfer.moved(skin.moved(withered)), mapped(mesh.positions, withered)),
                  0.01 * thickness_m)
            << name;
    }
}

TEST(SurfaceTransfer, FollowsWrinkles) {
    const SurfaceMesh mesh = test::sphere_mesh(192, 128);
    const auto wrinkled = [](const Vec3& p) -> Vec3 {
        const double number = 2 * std::numbers::pi / (10 * kThickness_m);
        const double depth = 0.5 * kThickness_m *
                             (std::sin(number * p.x() + 1) + std::sin(number * (0.6 * p.y() + 0.8 * p.z())));
        return p + depth * p.normalized();
    };
    const auto error = [&](int cells) {
        Skin skin(SphereMap(test::sphere_mesh(24, 16)), cells);
        // On the sphere itself: flat faces of the artist's mesh would be the larger error.
        for (auto& p : skin.rest) p = 0.04F * p.normalized();
        const SurfaceTransfer transfer(mesh.positions, vertex_normals(mesh.positions, mesh.faces), skin.rest,
                                       skin.brick.quads);
        const Points points = transfer.moved(skin.moved(wrinkled));
        double sum = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            sum += (points[i].cast<double>() - wrinkled(mesh.positions[i])).squaredNorm();
        return std::sqrt(sum / static_cast<double>(points.size())) / kThickness_m;
    };
    const double coarse = error(41), fine = error(82);
    EXPECT_LT(coarse, 0.02);
    EXPECT_LT(fine, coarse / 3) << "second order in the skin's edges or better";
}

TEST(SurfaceTransfer, BindsToItsOwnSideOfAThinBody) {
    SurfaceMesh leaf = test::sphere_mesh();
    for (Vec3& p : leaf.positions) p.z() *= 0.0005 / 0.04;
    const BrickSurface brick = make_brick_surface({24, 24, 24});
    Points rest, thick;
    for (const Vec3& d : brick_directions(brick, Vec3::Ones())) {
        rest.push_back((0.04 * Vec3(d.x(), d.y(), d.z() * 0.0125)).cast<float>());
        thick.push_back((0.04 * d).cast<float>());
    }
    // Drawn through the middle, nearer to the other side than to their own.
    std::vector<Vec3> vertices = leaf.positions;
    for (Vec3& p : vertices) p.z() *= -0.2;
    const auto normals = vertex_normals(leaf.positions, leaf.faces);
    const SurfaceTransfer transfer(vertices, normals, rest, brick.quads);
    const Points moved = transfer.moved(thick);
    int looked_at = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i].head<2>().norm() > 0.02) continue;
        ++looked_at;
        EXPECT_GT(moved[i].z() * leaf.positions[i].z(), 0) << i;
    }
    EXPECT_GT(looked_at, 500);
}

TEST(SurfaceTransfer, IsTheSameOnAnyNumberOfThreads) {
    const SurfaceMesh mesh = test::potato_mesh();
    const Skin skin(SphereMap(mesh), 16);
    const auto normals = vertex_normals(mesh.positions, mesh.faces);
    const Points shape = skin.moved(withered);
    const Points many = SurfaceTransfer(mesh.positions, normals, skin.rest, skin.brick.quads).moved(shape);
    const ThreadLimit one(1);
    EXPECT_EQ(SurfaceTransfer(mesh.positions, normals, skin.rest, skin.brick.quads).moved(shape), many);
}

TEST(SurfaceTransfer, RefusesWhatDoesNotFit) {
    const SurfaceMesh mesh = test::sphere_mesh(24, 16);
    const Skin skin(SphereMap(mesh), 12);
    const auto normals = vertex_normals(mesh.positions, mesh.faces);
    EXPECT_THROW(SurfaceTransfer(mesh.positions, {}, skin.rest, skin.brick.quads), InputError);
    auto astray = mesh.positions;
    astray[7] *= 2;
    EXPECT_THAT(message_of([&] { const SurfaceTransfer t(astray, normals, skin.rest, skin.brick.quads); }),
                testing::HasSubstr("vertex 7 at ("));
    const SurfaceTransfer transfer(mesh.positions, normals, skin.rest, skin.brick.quads);
    EXPECT_THROW(transfer.moved(Points(5)), InputError);
}

}  // namespace
}  // namespace windfall::geometry
