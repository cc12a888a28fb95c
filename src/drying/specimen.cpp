#include "drying/specimen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::drying {

using geometry::FruitShape;
using geometry::Vec3;

std::unique_ptr<FruitShape> make_shape(const FruitParameters& fruit) {
    const std::array<double, 8> radii = {1,        fruit.r2, fruit.r3, fruit.r4,
                                         fruit.r5, fruit.r6, fruit.r7, fruit.r8};
    return std::make_unique<geometry::TenNumberFruit>(radii, fruit.stone_r1, fruit.stone_r2);
}

double expected_wave_length(const DryingParameters& parameters) {
    return 2 * std::numbers::pi * parameters.fruit.skin_thickness * std::cbrt(parameters.material.gamma / 3);
}

double expected_onset(const DryingParameters& parameters) {
    constexpr double kBiaxial = 1.5;
    return 0.25 * std::pow(3 / parameters.material.gamma, 2.0 / 3) / kBiaxial;
}

BucklingLinearization buckling_linearization(const DryingParameters& parameters) {
    constexpr double kSafeFraction = 0.6;  // of the expected onset: surely not buckled yet
    constexpr double kBeyond = 0.1;        // of the shrinkage linearised about
    const double asked = parameters.imperfection.linearize_at;
    const double at = asked > 0 ? asked : kSafeFraction * expected_onset(parameters);
    return {at, at * (1 + kBeyond)};
}

namespace {

/// Mean thickness of the flesh over directions spread over the fruit.
double mean_flesh_thickness(const FruitShape& shape) {
    const geometry::BrickSurface brick = geometry::make_brick_surface({8, 8, 8});
    double sum = 0;
    const std::vector<Vec3> directions = geometry::brick_directions(brick, shape.half_extents());
    for (const Vec3& direction : directions)
        sum += shape.flesh_radius(direction) - shape.stone_radius(direction);
    return sum / static_cast<double>(directions.size());
}

}  // namespace

MeshPlan plan_mesh(const DryingParameters& parameters, const FruitShape& shape) {
    constexpr double kSteepest = 1.9;  // growth above which 16 layers are taken instead of 8
    constexpr double kElementsPerWave = 10;
    const MeshParameters& mesh = parameters.mesh;
    MeshPlan plan;
    const double thickness = parameters.fruit.skin_thickness;
    const double edge =
        std::min(mesh.edge_over_te * thickness, expected_wave_length(parameters) / kElementsPerWave);
    plan.cells = mesh.n > 0 ? geometry::brick_for_n(shape, static_cast<int>(mesh.n), mesh.elongation)
                            : geometry::brick_for_edge(shape, edge, mesh.elongation);
    plan.skin_layers = static_cast<int>(mesh.skin_layers);
    const double outermost = thickness / mean_flesh_thickness(shape);
    const auto growth_with = [&](int layers) {
        return mesh.growth > 0 ? mesh.growth
                               : geometry::growth_for_outermost(layers - plan.skin_layers, outermost);
    };
    plan.layers = static_cast<int>(mesh.layers);
    if (plan.layers == 0) plan.layers = mesh.growth > 0 || growth_with(8) <= kSteepest ? 8 : 16;
    plan.growth = growth_with(plan.layers);
    return plan;
}

geometry::LayeredMesh make_mesh(const DryingParameters& parameters, const FruitShape& shape) {
    const MeshPlan plan = plan_mesh(parameters, shape);
    return geometry::make_layered_mesh(
        shape, parameters.fruit.skin_thickness, plan.cells,
        geometry::graded_layers(plan.layers - plan.skin_layers, plan.skin_layers, plan.growth));
}

}  // namespace windfall::drying
