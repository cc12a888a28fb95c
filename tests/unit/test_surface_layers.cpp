#include "geometry/surface_layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geometry/stone_lines.h"
#include "support/message_of.h"
#include "support/test_surfaces.h"

namespace windfall::geometry {
namespace {

/// A fruit with a brick on it, ready for layers.
struct Fruit {
    SurfaceMesh mesh;
    SphereMap map;
    CurvedSurface surface;
    LaidBrick laid;
    double r1, skin;

    Fruit(const SurfaceMesh& its_mesh, double elongation, double skin_over_r1 = 0.05)
        : mesh(its_mesh),
          map(mesh),
          surface(map.surface()),
          laid(lay_brick(surface, map, brick_of(16, elongation))),
          r1(std::cbrt(volume() / (4 * std::numbers::pi / 3))),
          skin(skin_over_r1 * r1) {}

    double volume() const { return enclosed_volume(mesh.positions, mesh.faces); }
    SurfaceColumns columns() const {
        SurfaceColumns result{surface, laid, {}, skin, graded_layers(6, 2, 1.35)};
        for (const SurfaceSpot& spot : laid.spots) result.directions.push_back(map.direction(spot.place));
        return result;
    }
};

CurvedSurface base_as_stone(const LayeredMesh& mesh) {
    SurfaceMesh stone{mesh.base, mesh.faces(), {}};
    return CurvedSurface(welded_triangles(stone));
}

TEST(SurfaceLayers, OfAPotatoAreSoundToAnyStone) {
    const Fruit fruit(test::potato_mesh(48, 32), 1);
    const SurfaceColumns columns = fruit.columns();
    const LayeredMesh made = layers_to_made_stone(columns, kAutomaticStone);
    EXPECT_GT(worst_corner(made).scaled_jacobian, 0.3);
    // The outermost nodes lie on the given surface, the skin has its thickness.
    for (std::size_t c = 0; c < made.columns(); ++c) {
        EXPECT_LT((made.node(c, 8) - fruit.laid.spots[c].point).norm(), 1e-12);
        EXPECT_NEAR((made.node(c, 8) - made.node(c, 6)).norm(), fruit.skin, 1e-12);
    }
    const LayeredMesh none = layers_to_core(columns, fruit.map);
    EXPECT_GT(worst_corner(none).scaled_jacobian, 0.3);
    EXPECT_LT(enclosed_volume(none.base, none.faces()), 0.03 * fruit.volume());
    EXPECT_GT(worst_corner(layers_to_stone(columns, base_as_stone(made))).scaled_jacobian, 0.3);
}

TEST(SurfaceLayers, AWorstCornerIsFound) {
    const Fruit fruit(test::sphere_mesh(32, 24), 1);
    LayeredMesh mesh = layers_to_made_stone(fruit.columns(), kAutomaticStone);
    mesh.nodes[5 * 8 + 3] += 5 * fruit.skin * mesh.outward[5];  // above the nodes over it
    const WorstCorner worst = worst_corner(mesh);
    EXPECT_LT(worst.scaled_jacobian, 0);
    EXPECT_LT((worst.place - mesh.node(5, 4)).norm(), 0.3 * fruit.r1);
}

TEST(SurfaceLayers, AStoneThatPiercesTheSkinIsNamedWithItsPlace) {
    const CurvedSurface fruit(welded_triangles(test::sphere_mesh(32, 24, 0.04)));
    const auto ball_at = [](double x, double radius) {
        SurfaceMesh mesh = test::sphere_mesh(32, 24, radius);
        for (Vec3& p : mesh.positions) p.x() += x;
        return CurvedSurface(welded_triangles(mesh));
    };
    EXPECT_NO_THROW(require_inside(fruit, ball_at(0, 0.02), 0.004));
    EXPECT_THAT(message_of([&] { require_inside(fruit, ball_at(0.03, 0.02), 0.004); }),
                testing::HasSubstr("pierces the skin near (0.0"));
    EXPECT_THAT(message_of([&] { require_inside(fruit, ball_at(0.017, 0.02), 0.004); }),
                testing::HasSubstr("comes too close to the skin near (0.03"));
}

}  // namespace
}  // namespace windfall::geometry
