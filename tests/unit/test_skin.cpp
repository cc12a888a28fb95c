#include "decay/skin.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "decay/body_embedding.h"
#include "decay/body_measure.h"
#include "decay/body_neighbours.h"
#include "geometry/layered_mesh.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;

struct Ball {
    geometry::BrickSurface brick;
    std::vector<Vec3> directions, points;
    std::vector<geometry::Face> faces;
    std::vector<Eigen::Vector3f> single;

    Ball(int cells, double radius_m, const Vec3& centre = Vec3::Zero())
        : brick(geometry::make_brick_surface({cells, cells, cells})),
          directions(geometry::brick_directions(brick, Vec3::Ones())),
          faces(brick.quads.begin(), brick.quads.end()) {
        for (const Vec3& d : directions) {
            points.emplace_back(centre + radius_m * d);
            single.emplace_back(points.back().cast<float>());
        }
    }
    std::vector<Eigen::Vector3f> scaled(float by) const {
        auto result = single;
        for (auto& x : result) x *= by;
        return result;
    }
};

std::vector<ContactPlane> no_planes(std::size_t count) { return std::vector<ContactPlane>(count); }

TEST(SkinMesh, NoTwoVerticesOfAColourAreWithinTwoLinks) {
    const Ball ball(9, 0.03);
    const SkinMesh mesh = make_skin_mesh(ball.brick, ball.points);
    ASSERT_EQ(mesh.size(), ball.points.size());
    EXPECT_LE(mesh.colour_begin.size(), 20U);
    for (std::size_t c = 0; c + 1 < mesh.colour_begin.size(); ++c)
        for (auto i = mesh.colour_begin[c]; i < mesh.colour_begin[c + 1]; ++i) {
            std::set<std::int32_t> near;
            for (auto p = mesh.begin[i]; p < mesh.begin[i + 1]; ++p) {
                const auto j = mesh.neighbours[p].vertex;
                near.insert(j);
                for (auto q = mesh.begin[j]; q < mesh.begin[j + 1]; ++q)
                    if (mesh.neighbours[q].vertex != i) near.insert(mesh.neighbours[q].vertex);
            }
            for (const auto j : near) EXPECT_FALSE(j >= mesh.colour_begin[c] && j < mesh.colour_begin[c + 1]);
        }
}

TEST(SkinMesh, SpringsOfAnEvenStretchStoreTheSheetsEnergy) {
    const Ball ball(24, 0.03);
    const SkinMesh mesh = make_skin_mesh(ball.brick, ball.points);
    // Even strain e of a sheet with nu = 1/3: energy E t e^2 / (1 - nu) per area.
    double energy = 0;
    double area = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        area += mesh.area_m2[i];
        for (auto p = mesh.begin[i]; p < mesh.begin[i + 1]; ++p) {
            const auto& a = ball.points[mesh.vertex_of[i]];
            const auto& b = ball.points[mesh.vertex_of[mesh.neighbours[p].vertex]];
            energy += 0.25 * mesh.neighbours[p].spring * (a - b).squaredNorm();
        }
    }
    EXPECT_NEAR(energy, area * 1.5, 0.05 * energy);
}

TEST(SkinMaterial, BucklesAtTheWaveLengthAndStrainAskedFor) {
    const SkinMaterial m = skin_material(10e6, 0.3e-3, 8.7e5, 1e-3, 0.009);
    EXPECT_NEAR(2 * std::numbers::pi * std::pow(m.bending_nm / m.tether_pa_m, 0.25), 0.009, 1e-9);
    EXPECT_NEAR(2 * std::sqrt(m.tether_pa_m * m.bending_nm) / m.membrane_n_m, 0.015, 1e-9);
    // Of itself: stiff sheet on soft ground, not below six edges, not above 20 mm.
    const double free_wave = 2 * std::numbers::pi * 0.9e-3 * std::cbrt(10e6 / (3 * 1e5));
    EXPECT_NEAR(skin_material(10e6, 0.9e-3, 1e5, 1e-3, 0).wave_length_m, free_wave, 1e-9);
    EXPECT_NEAR(skin_material(10e6, 1e-4, 1e6, 1e-3, 0).wave_length_m, 6e-3, 1e-9);
    EXPECT_NEAR(skin_material(10e6, 3e-3, 2e3, 1e-3, 0).wave_length_m, 0.02, 1e-9);
}

/// Mean number of crests met along great circles gives the wave length: 2 pi R over half the sign changes.
double measured_wave_length(const Ball& ball, const std::vector<Eigen::Vector3f>& x, double radius_m) {
    // Rice's formula for an isotropic field on the sphere: (2 pi / L)^2 = <|grad h|^2> 2 / <h^2> / 2.
    std::vector<double> h(x.size());
    double mean = 0;
    for (std::size_t i = 0; i < x.size(); ++i) mean += h[i] = x[i].cast<double>().norm();
    mean /= static_cast<double>(x.size());
    double square = 0;
    double gradient = 0;
    double links = 0;
    for (double& v : h) square += std::pow(v -= mean, 2) / static_cast<double>(x.size());
    for (const auto& q : ball.brick.quads)
        for (int k = 0; k < 4; ++k) {
            const auto a = q[k];
            const auto b = q[(k + 1) % 4];
            // |grad h|^2 is twice the mean square slope along one direction.
            gradient += 2 * std::pow(h[a] - h[b], 2) / (radius_m * radius_m) /
                        (ball.directions[a] - ball.directions[b]).squaredNorm();
            links += 1;
        }
    return 2 * std::numbers::pi / std::sqrt(gradient / links / square);
}

TEST(Skin, WrinklesWhenTheFleshShrinksAtTheWaveLengthItWasGiven) {
    constexpr double kRadius_m = 0.035;
    constexpr double kWave_m = 0.012;
    const Ball ball(34, kRadius_m);
    Skin skin(ball.brick, ball.points);
    skin.set_material(skin_material(10e6, 0.3e-3, 8.7e5, skin.mesh().mean_edge_m, kWave_m));
    std::vector<float> stretch;
    for (const Vec3& d : ball.directions)
        stretch.push_back(
            static_cast<float>(0.01 * std::sin(20 * d.x() + 1) * std::cos(23 * d.y() - d.z() * 17)));
    skin.lay(ball.single, stretch);
    constexpr int kFrames = 100;
    for (int f = 1; f <= kFrames; ++f)
        skin.advance(ball.scaled(1 - 0.06F * f / kFrames), no_planes(ball.points.size()), {});
    double depth = 0;
    for (const auto& x : skin.positions()) depth = std::max(depth, std::abs(x.norm() - 0.94 * kRadius_m));
    EXPECT_GT(depth, 0.2e-3);
    EXPECT_NEAR(measured_wave_length(ball, skin.positions(), 0.94 * kRadius_m), kWave_m, 0.25 * kWave_m);
    EXPECT_EQ(crossing_edges(skin.positions(), ball.faces), 0);
    // Wrinkles store far less than the skin would, were it pressed flat: E t e^2 / (1 - nu) per area.
    const double flat = 3e3 * std::pow(0.06 / 0.94, 2) * 1.5 * 4 * std::numbers::pi * std::pow(kRadius_m, 2);
    EXPECT_LT(skin.energy_j(), 0.5 * flat);
    EXPECT_GT(skin.energy_j(), 0.02 * flat);
    // Compressed skin does not make the fruit larger.
    EXPECT_NEAR(surface_volume_m3(skin.positions(), ball.faces),
                surface_volume_m3(ball.scaled(0.94F), ball.faces), 2e-3 * 1.8e-4);
}

TEST(Skin, StaysWhereItLiesWithoutLoad) {
    const Ball ball(12, 0.03);
    Skin skin(ball.brick, ball.points);
    skin.set_material(skin_material(10e6, 0.3e-3, 8.7e5, skin.mesh().mean_edge_m, 0));
    skin.advance(ball.single, no_planes(ball.points.size()), {});
    for (std::size_t i = 0; i < ball.single.size(); ++i)
        EXPECT_LT((skin.positions()[i] - ball.single[i]).norm(), 1e-7F);
    EXPECT_NEAR(skin.energy_j(), 0, 1e-12);
}

TEST(Skin, KeepsOutOfPlanesWhateverTheTarget) {
    const Ball ball(12, 0.03, Vec3(0, 0, 0.028));  // 2 mm below the table
    Skin skin(ball.brick, ball.points);
    skin.set_material(skin_material(10e6, 0.3e-3, 8.7e5, skin.mesh().mean_edge_m, 0));
    const std::vector<ContactPlane> table(ball.points.size(), {{0, 0, 1}, 0});
    const std::vector<ContactPlane> wall(ball.points.size(), {{-1, 0, 0}, -0.029F});
    skin.advance(ball.single, table, wall);
    for (const auto& x : skin.positions()) {
        EXPECT_GE(x.z(), -1e-6F);
        EXPECT_LE(x.x(), 0.029F + 1e-6F);
    }
}

TEST(BodyEmbedding, CarriesAffineMapsExactlyAndBendsSmoothly) {
    const Ball coarse(5, 0.03), fine(20, 0.03);
    const BodyEmbedding embedding(coarse.brick, coarse.points, fine.brick, fine.points);
    Eigen::Matrix3f A;
    A << 0.9F, 0.1F, 0, -0.05F, 1.1F, 0.2F, 0, 0, 0.8F;
    std::vector<Eigen::Vector4f> moved;
    for (const auto& x : coarse.single) {
        const Eigen::Vector3f y = A * x + Eigen::Vector3f(0.1F, 0, 0);
        moved.emplace_back(y.x(), y.y(), y.z(), 0.0F);
    }
    std::vector<Eigen::Vector3f> result;
    embedding.map(moved, std::vector<Eigen::Matrix3f>(moved.size(), A), result);
    for (std::size_t i = 0; i < result.size(); ++i)
        EXPECT_LT((result[i] - (A * fine.single[i] + Eigen::Vector3f(0.1F, 0, 0))).norm(), 1e-7F);
    const auto mean = embedding.coarsen(std::vector<float>(fine.points.size(), 0.7F));
    for (const float value : mean) EXPECT_NEAR(value, 0.7F, 1e-6F);
}

TEST(BodyMeasure, BallsVolumeAreaAndCrossings) {
    const Ball ball(24, 0.03);
    EXPECT_NEAR(surface_volume_m3(ball.single, ball.faces), 4.0 / 3 * std::numbers::pi * 2.7e-5, 1e-6);
    EXPECT_NEAR(surface_area_m2(ball.single, ball.faces), 4 * std::numbers::pi * 9e-4, 5e-5);
    EXPECT_EQ(crossing_edges(ball.single, ball.faces), 0);
    auto folded = ball.single;
    folded[ball.brick.side_vertices[5][12 * 25 + 12]] -= Eigen::Vector3f(3e-4F, 5e-4F, 0.07F);  // out below
    EXPECT_GT(crossing_edges(folded, ball.faces), 0);
}

TEST(BodyNeighbours, SignedDistanceOfABall) {
    const Ball ball(24, 0.03);
    const MeasuredSurface surface(ball.single, ball.faces, 0.006F);
    for (const double r : {0.027, 0.0295, 0.031, 0.034})
        for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0.3, -0.5, 0.7)})
            EXPECT_NEAR(surface.signed_distance_m((r * d.normalized()).cast<float>()), r - 0.03, 6e-5);
    EXPECT_TRUE(std::isinf(surface.signed_distance_m({0.05F, 0, 0})));
    // Half way between the point and the ball, facing the point.
    const NearSurface near(ball.single, ball.faces, 0.006F);
    const ContactPlane plane = near.half_way({0.033F, 0, 0});
    EXPECT_NEAR(plane.gap_m({0.033F, 0, 0}), 0.0015, 1e-4);
    EXPECT_NEAR(plane.normal.x(), 1, 2e-3);
}

}  // namespace
}  // namespace windfall::decay
