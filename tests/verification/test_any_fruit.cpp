// Fruit that are meshes: hexahedra of every shape, and drying to 0.25 without a fold that passes through
// another.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "drying/drying_process.h"
#include "drying/specimen.h"
#include "geometry/surface_check_crossings.h"
#include "geometry/surface_layers.h"
#include "recipe/fruit_file.h"
#include "recipe/recipe.h"
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

/// For the tables of docs/any-fruit.md.
void print_edges(const std::string& name, const BrickSurface& brick, const EdgeStatistics& edges) {
    std::printf("%s %d x %d x %d: edge / mean %.2f-%.2f, longest / shortest %.1f,", name.c_str(),
                brick.cells[0], brick.cells[1], brick.cells[2], edges.smallest_over_mean,
                edges.largest_over_mean, edges.largest_over_mean / edges.smallest_over_mean);
}

class AnyFruit : public testing::TestWithParam<int> {};

TEST_P(AnyFruit, HasEvenEdgesAndSoundHexahedraToAnyStone) {
    const auto [name, mesh] = test::fruit_meshes()[static_cast<std::size_t>(GetParam())];
    const Fruit fruit(mesh, name == "banana" ? 6 : name == "bean" ? 2 : name == "pear" ? 1.5 : 1);
    const EdgeStatistics edges = edge_statistics(fruit.laid.positions(), fruit.laid.brick.quads);
    EXPECT_LT(edges.largest_over_mean, 3 * edges.smallest_over_mean) << name;

    const SurfaceColumns columns = fruit.columns();
    const LayeredMesh made = layers_to_made_stone(columns, kAutomaticStone);
    EXPECT_GT(worst_corner(made).scaled_jacobian, 0.1) << name;
    // Counter-clockwise from outside, and all of the body inside.
    const auto surface = made.level_positions(made.layers);
    EXPECT_NEAR(enclosed_volume(surface, made.faces()) / fruit.volume(), 1, 0.03) << name;

    const LayeredMesh none = layers_to_core(columns, fruit.map);
    EXPECT_GT(worst_corner(none).scaled_jacobian, 0.1) << name;
    EXPECT_LT(enclosed_volume(none.base, none.faces()), 0.03 * fruit.volume()) << name;

    const LayeredMesh given = layers_to_stone(columns, base_as_stone(made));
    EXPECT_GT(worst_corner(given).scaled_jacobian, 0.1) << name;
    print_edges(name, fruit.laid.brick, edges);
    std::printf(" smallest scaled Jacobian: made %.2f, none %.2f, mesh %.2f\n",
                worst_corner(made).scaled_jacobian, worst_corner(none).scaled_jacobian,
                worst_corner(given).scaled_jacobian);
}

INSTANTIATE_TEST_SUITE_P(EveryFruit, AnyFruit, testing::Range(0, 5));

TEST(AnyFruitPresets, HaveEvenEdgesAndSoundHexahedra) {
    for (const char* name : {"potato", "pepper", "fig", "bean", "banana"})
        for (const char* cells : {"mesh.n=24", "mesh.n=40"}) {
            const drying::DryingParameters p = recipe::load(name, {cells}).drying;
            const LayeredMesh mesh = drying::make_mesh(p, *recipe::read_fruit(p));
            const EdgeStatistics edges = edge_statistics(mesh.level_positions(mesh.layers), mesh.brick.quads);
            EXPECT_LT(edges.largest_over_mean, 3 * edges.smallest_over_mean) << name << ", " << cells;
            EXPECT_GT(worst_corner(mesh).scaled_jacobian, 0.1) << name << ", " << cells;
            print_edges(name, mesh.brick, edges);
            std::printf(" smallest scaled Jacobian %.2f\n", worst_corner(mesh).scaled_jacobian);
        }
}

}  // namespace
}  // namespace windfall::geometry

namespace windfall::drying {
namespace {

/// Keeps the mesh and the last frame.
class LastFrame final : public take::FrameSink {
  public:
    void add_mesh(const take::TakeMesh& its_mesh) override { mesh = its_mesh; }
    void add_frame(const take::Frame& its_frame) override { frame = its_frame; }
    void save_checkpoint(std::span<const std::byte>) override {}
    void set_summary(const nlohmann::json&) override {}

    take::TakeMesh mesh;
    take::Frame frame;
};

class AnyFruitDried : public testing::TestWithParam<int> {};

TEST_P(AnyFruitDried, WrinklesAndDoesNotPassThroughItself) {
    const auto [name, surface] = test::fruit_meshes()[static_cast<std::size_t>(GetParam())];
    DryingParameters p;
    p.fruit.mesh = name;
    p.fruit.skin_thickness = 0.05;
    p.fruit.uvs = TakeSkin::Atlas;
    p.mesh.n = name == "banana" ? 16 : 24;
    p.drying.shrinkage = 0.25;
    p.output.frames = 2;
    LastFrame last;
    run(p, {std::make_unique<const ArtistFruit>(ArtistMeshes{surface, {}}, p), {}}, last, {});
    const take::FrameMesh& dry = last.frame.meshes.front();
    double depth_sq = 0;
    for (const float d : dry.find("depth")->values)
        depth_sq += d * d / static_cast<double>(dry.positions.size());
    EXPECT_GT(std::sqrt(depth_sq), 0.1 * p.fruit.skin_thickness) << name;
    EXPECT_NEAR(last.frame.scalars.at("flesh_volume_ratio"), std::pow(0.75, 3), 0.02) << name;
    geometry::SurfaceMesh skin{{}, last.mesh.rest.faces, {}};
    for (const auto& x : dry.positions) skin.positions.emplace_back(x.cast<double>());
    EXPECT_TRUE(geometry::self_crossings(geometry::welded_triangles(skin)).empty()) << name;
}

INSTANTIATE_TEST_SUITE_P(EveryFruit, AnyFruitDried, testing::Range(0, 5));

}  // namespace
}  // namespace windfall::drying
