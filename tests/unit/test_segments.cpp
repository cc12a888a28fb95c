#include "drying/segments.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "drying/element.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

constexpr int kLayers = 8;

SegmentParameters ten_segments() {
    SegmentParameters segments;
    segments.count = 10;
    segments.wall_width = 0.2;
    return segments;
}

TEST(Segments, NoneByDefault) {
    EXPECT_TRUE(wall_parts(test::small_sphere(4, kLayers), {}).empty());
    EXPECT_TRUE(wall_stiffening({}, {}).empty());
}

TEST(Segments, WallsTakeTheirShareAndStandAtEvenLongitudes) {
    const geometry::LayeredMesh mesh = test::small_sphere(32, kLayers);
    const std::vector<double> walls = wall_parts(mesh, ten_segments());
    double around = 0;
    int at_equator = 0;
    for (std::size_t q = 0; q < walls.size(); ++q) {
        EXPECT_GE(walls[q], -1e-12);
        EXPECT_LE(walls[q], 1 + 1e-12);
        geometry::Vec3 middle = geometry::Vec3::Zero();
        for (const std::int32_t v : mesh.brick.quads[q]) middle += mesh.directions[v];
        if (std::abs(middle.y()) > 0.2) continue;
        // A wall stands at longitude 0, where x is positive, and none half a segment further.
        const double segments_around = std::atan2(middle.z(), middle.x()) * 10 / (2 * M_PI);
        const double from_wall = std::abs(segments_around - std::round(segments_around));
        if (from_wall > 0.3) {
            EXPECT_NEAR(walls[q], 0, 1e-12);
        }
        around += walls[q];
        ++at_equator;
    }
    EXPECT_NEAR(around / at_equator, 0.2, 0.005);
}

TEST(Segments, WallsShrinkLessAndOnlyInTheFlesh) {
    SegmentParameters segments = ten_segments();
    segments.wall_shrinkage = 0.25;
    const std::vector<double> walls = {0, 1, 0.5};
    const DryingField field =
        with_walls([](std::size_t, int) -> Eigen::Matrix3d { return 0.8 * Eigen::Matrix3d::Identity(); },
                   walls, segments, 6);
    EXPECT_NEAR(field(0, 0)(0, 0), 0.8, 1e-15);
    EXPECT_NEAR(field(1, 0)(0, 0), 0.95, 1e-15);
    EXPECT_NEAR(field(2, 5)(1, 1), 0.875, 1e-15);
    EXPECT_NEAR(field(1, 6)(0, 0), 0.8, 1e-15);
}

/// The kernels with moduli that differ from quad to quad against the plain element.
TEST(Segments, EnergyIsThatOfThePlainElement) {
    const geometry::LayeredMesh mesh = test::small_sphere(4, kLayers);
    std::vector<double> stiffening;
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q)
        stiffening.push_back(1 + 0.5 * static_cast<double>(q % 7));
    const LayerModuli moduli = layer_moduli(mesh.flesh_layers, kLayers, 10, 50);
    Multigrid multigrid(mesh.brick, kLayers, kernels(kLayers));
    Elasticity elasticity(mesh, moduli, multigrid, stiffening);
    elasticity.set_drying(test::uneven_drying);
    const AlignedArray<double> u = test::random_displacement(elasticity.size(), 0.01, 4);

    geometry::LayeredMesh now = mesh;
    const ColumnOrder& order = multigrid.order();
    for (std::size_t c = 0; c < mesh.columns(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < kLayers; ++k)
                now.nodes[static_cast<std::size_t>(order.vertex_of_solver[c]) * kLayers + k]
                         [static_cast<int>(i)] += u[(3 * c + i) * kLayers + k];
    double expected = 0;
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q)
        for (int k = 0; k < kLayers; ++k) {
            const double factor = k < mesh.flesh_layers ? stiffening[q] : 1;
            const auto layer = static_cast<std::size_t>(k);
            expected += hexahedron_response(element_nodes(mesh, q, k), element_nodes(now, q, k),
                                            {factor * moduli.shear[layer], factor * moduli.bulk[layer],
                                             test::uneven_drying(q, k)})
                            .energy;
        }
    EXPECT_NEAR(elasticity.energy(u, nullptr).energy, expected, 1e-9 * expected);

    // The matrix is the derivative of the force.
    AlignedArray<float> way(u.size()), image(u.size());
    AlignedArray<double> ahead = u, behind = u, force_ahead(u.size()), force_behind(u.size());
    const AlignedArray<double> direction = test::random_displacement(u.size(), 1, 5);
    constexpr double kStep = 1e-6;
    for (std::size_t i = 0; i < u.size(); ++i) {
        way[i] = static_cast<float>(direction[i]);
        ahead[i] += kStep * direction[i];
        behind[i] -= kStep * direction[i];
    }
    elasticity.energy(ahead, &force_ahead);
    elasticity.energy(behind, &force_behind);
    elasticity.assemble(u, 1, 0);
    multigrid.product(way.data(), image.data());
    double difference = 0;
    double size = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double derivative = (force_ahead[i] - force_behind[i]) / (2 * kStep);
        difference += std::pow(derivative - image[i], 2);
        size += derivative * derivative;
    }
    EXPECT_LT(std::sqrt(difference / size), 1e-4);
}

}  // namespace
}  // namespace windfall::drying
