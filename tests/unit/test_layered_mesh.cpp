#include "geometry/layered_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "drying/element.h"

namespace windfall::geometry {
namespace {

TEST(LayeredMesh, LayersFillFleshAndSkin) {
    const LayerFractions fractions = graded_layers(6, 2, 1.35);
    EXPECT_EQ(fractions.count(), 8);
    EXPECT_NEAR(std::accumulate(fractions.flesh.begin(), fractions.flesh.end(), 0.0), 1, 1e-14);
    EXPECT_NEAR(std::accumulate(fractions.skin.begin(), fractions.skin.end(), 0.0), 1, 1e-14);
    for (std::size_t k = 1; k < fractions.flesh.size(); ++k)
        EXPECT_NEAR(fractions.flesh[k - 1] / fractions.flesh[k], 1.35, 1e-12);
}

TEST(LayeredMesh, GrowthGivesTheOutermostLayerAskedFor) {
    for (const double outermost : {0.02, 0.05, 0.1}) {
        const double growth = growth_for_outermost(6, outermost);
        EXPECT_NEAR(graded_layers(6, 2, growth).flesh.back(), outermost, 1e-9);
    }
    EXPECT_NEAR(growth_for_outermost(6, 0.9), 1, 1e-9);
}

TEST(LayeredMesh, VolumeConvergesToTheShellAtSecondOrder) {
    const SphereShape sphere(1, 0.4);
    const double exact = 4 * std::numbers::pi / 3 * (std::pow(1.1, 3) - std::pow(0.4, 3));
    std::vector<double> errors;
    for (const int n : {8, 16, 32}) {
        const LayeredMesh mesh = make_layered_mesh(sphere, 0.1, {n, n, n}, graded_layers(6, 2, 1.3));
        double volume = 0;
        for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q)
            for (int k = 0; k < mesh.layers; ++k)
                volume += drying::hexahedron_volume(drying::element_nodes(mesh, q, k));
        errors.push_back(std::abs(volume / exact - 1));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.1);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05);
}

TEST(LayeredMesh, SkinLiesAsFarOutAsItIsThick) {
    const TenNumberFruit fruit({1, 0.9, 0.75, 0.7, 0.75, 0.9, 1, 0.6}, 0.4, 0.3);
    const LayeredMesh mesh = make_layered_mesh(fruit, 0.05, {8, 16, 8}, graded_layers(6, 2, 1.3));
    for (std::size_t c = 0; c < mesh.columns(); ++c) {
        EXPECT_NEAR(mesh.node(c, 8).norm() - mesh.node(c, 6).norm(), 0.05, 1e-12);
        EXPECT_NEAR(mesh.node(c, 6).norm(), fruit.flesh_radius(mesh.directions[c]), 1e-12);
        EXPECT_NEAR(mesh.node(c, 0).norm(), fruit.stone_radius(mesh.directions[c]), 1e-12);
    }
}

TEST(LayeredMesh, EdgesAreEvenOnRoundAndLongFruit) {
    for (const double width : {1.0, 0.8, 0.62, 0.5}) {
        std::array<double, 8> radii{};
        for (int i = 0; i < 7; ++i) {
            const double phi = -std::numbers::pi / 2 + i * std::numbers::pi / 6;
            radii[i] = 1 / std::hypot(std::sin(phi), std::cos(phi) / width);
        }
        radii[7] = width;
        const TenNumberFruit fruit(radii, 0.3, 0.3 * width);
        const Lattice cells = brick_for_edge(fruit, 0.03, 0);
        const LayeredMesh mesh = make_layered_mesh(fruit, 0.04, cells, graded_layers(6, 2, 1.35));
        const EdgeStatistics edges =
            edge_statistics(mesh.level_positions(mesh.flesh_layers), mesh.brick.quads);
        EXPECT_LT(edges.mean, 0.0315) << width;
        EXPECT_GT(edges.mean, 0.023) << width;
        EXPECT_GT(edges.smallest_over_mean, 0.6) << width;
        EXPECT_LT(edges.largest_over_mean, 1.7) << width;
        if (width < 0.7) {
            EXPECT_GT(cells[1], cells[0]) << width;
        }
    }
}

TEST(LayeredMesh, FoldedMeshesAreRefusedWithPlaceAndRemedy) {
    LayeredMesh mesh = make_layered_mesh(SphereShape(1, 0.4), 0.1, {8, 8, 8}, graded_layers(6, 2, 1));
    EXPECT_NO_THROW(check_corners(mesh, "unused"));
    mesh.nodes[5 * 8 + 3] += 0.5 * mesh.directions[5];  // above the nodes over it
    try {
        check_corners(mesh, "be gentle");
        FAIL() << "a folded mesh was taken";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("near ("), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("be gentle"), std::string::npos);
    }
}

TEST(LayeredMesh, MeshesBeyondReasonAreRefusedBeforeTheyAreMade) {
    EXPECT_THROW(brick_for_edge(SphereShape(1, 0.4), 1e-4, 0), InputError);
    const Lattice fine = brick_for_edge(SphereShape(1, 0.4), 0.0078, 0);
    EXPECT_EQ(fine[0] % 32, 0);
    EXPECT_EQ(fine[1] % 32, 0);
}

}  // namespace
}  // namespace windfall::geometry
