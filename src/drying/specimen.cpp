#include "drying/specimen.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/surface_layers.h"

namespace windfall::drying {

using geometry::FruitShape;
using geometry::Vec3;

std::unique_ptr<FruitShape> make_shape(const FruitParameters& fruit) {
    if (!fruit.mesh.empty()) throw std::logic_error("an artist's mesh has no ten numbers");
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

/// Everything but the cells, for flesh of a mean thickness (r_1).
MeshPlan plan_layers(const DryingParameters& parameters, double flesh_thickness) {
    // Growth above which 16 layers are taken instead of 8. With 1.97 (a sphere with t_e 0.01) they change the
    // onset by 1.6 % and the depth by 1.4 % (docs/drying.md), for twice the unknowns.
    constexpr double kSteepest = 2;
    const MeshParameters& mesh = parameters.mesh;
    MeshPlan plan;
    plan.skin_layers = static_cast<int>(mesh.skin_layers);
    const double outermost = parameters.fruit.skin_thickness / flesh_thickness;
    const auto growth_with = [&](int layers) {
        return mesh.growth > 0 ? mesh.growth
                               : geometry::growth_for_outermost(layers - plan.skin_layers, outermost);
    };
    plan.layers = static_cast<int>(mesh.layers);
    if (plan.layers == 0) plan.layers = mesh.growth > 0 || growth_with(8) <= kSteepest ? 8 : 16;
    plan.growth = growth_with(plan.layers);
    return plan;
}

/// Mean thickness of the flesh under an artist's skin (r_1): to a core by the ball of the same volume, to a
/// stone by the balls that fit in.
double mean_flesh_thickness(const DryingParameters& parameters, const ArtistFruit& fruit) {
    constexpr double kToCore = 0.75;
    constexpr double kLeast = 0.8;  // skins
    const double skin = parameters.fruit.skin_thickness;
    if (parameters.fruit.stone == StoneKind::None) return kToCore;
    const Thickness thickness = thickness_of(fruit.mesh(), skin * fruit.r1());
    const double share = geometry::kAutomaticStone.shares.front();
    return std::max(share * thickness.mean / fruit.r1() - skin, kLeast * skin);
}

}  // namespace

double wanted_edge(const DryingParameters& parameters) {
    constexpr double kElementsPerWave = 10;
    return std::min(parameters.mesh.edge_over_te * parameters.fruit.skin_thickness,
                    expected_wave_length(parameters) / kElementsPerWave);
}

MeshPlan plan_mesh(const DryingParameters& parameters, const FruitShape& shape) {
    const MeshParameters& mesh = parameters.mesh;
    MeshPlan plan = plan_layers(parameters, mean_flesh_thickness(shape));
    plan.cells = mesh.n > 0 ? geometry::brick_for_n(shape, static_cast<int>(mesh.n), mesh.elongation)
                            : geometry::brick_for_edge(shape, wanted_edge(parameters), mesh.elongation);
    return plan;
}

MeshPlan plan_mesh(const DryingParameters& parameters, const ArtistFruit& fruit) {
    MeshPlan plan = plan_layers(parameters, mean_flesh_thickness(parameters, fruit));
    const double edge = wanted_edge(parameters) * fruit.r1();
    const int n = parameters.mesh.n > 0
                      ? static_cast<int>(parameters.mesh.n)
                      : geometry::cells_for(fruit.surface().area(), edge, fruit.elongation());
    plan.cells = geometry::brick_of(n, fruit.elongation());
    return plan;
}

geometry::LayeredMesh make_mesh(const DryingParameters& parameters, const FruitShape& shape) {
    const MeshPlan plan = plan_mesh(parameters, shape);
    return geometry::make_layered_mesh(
        shape, parameters.fruit.skin_thickness, plan.cells,
        geometry::graded_layers(plan.layers - plan.skin_layers, plan.skin_layers, plan.growth));
}

namespace {

/// Besides the harmonics: what a body that is no ball does when it shrinks. Its points move with their place,
/// and along the normal with the thickness of the flesh under them.
Eigen::MatrixXd slow_functions_of(const geometry::LayeredMesh& mesh) {
    constexpr int kFunctions = 3 + 6 + 3 + 3;
    Eigen::MatrixXd functions(static_cast<Eigen::Index>(mesh.columns()), kFunctions);
    Vec3 centre = Vec3::Zero();
    for (std::size_t c = 0; c < mesh.columns(); ++c)
        centre += mesh.node(c, mesh.layers) / static_cast<double>(mesh.columns());
    for (std::size_t c = 0; c < mesh.columns(); ++c) {
        const Vec3 x = mesh.node(c, mesh.layers) - centre;
        const Vec3& n = mesh.outward[c];
        const double thickness = (mesh.node(c, mesh.layers) - mesh.base[c]).norm();
        functions.row(static_cast<Eigen::Index>(c)) << x.transpose(), x.x() * x.x(), x.y() * x.y(),
            x.z() * x.z(), x.x() * x.y(), x.y() * x.z(), x.z() * x.x(), n.transpose(),
            thickness * n.transpose();
    }
    return functions;
}

}  // namespace

geometry::LayeredMesh make_mesh(const DryingParameters& parameters, const ArtistFruit& fruit) {
    const MeshPlan plan = plan_mesh(parameters, fruit);
    const geometry::LaidBrick laid = geometry::lay_brick(fruit.surface(), fruit.map(), plan.cells);
    geometry::SurfaceColumns columns{
        fruit.surface(),
        laid,
        {},
        parameters.fruit.skin_thickness * fruit.r1(),
        geometry::graded_layers(plan.layers - plan.skin_layers, plan.skin_layers, plan.growth)};
    for (const geometry::SurfaceSpot& spot : laid.spots)
        columns.directions.push_back(fruit.map().direction(spot.place));
    geometry::LayeredMesh mesh = fruit.stone() != nullptr ? geometry::layers_to_stone(columns, *fruit.stone())
                                 : parameters.fruit.stone == StoneKind::None
                                     ? geometry::layers_to_core(columns, fruit.map())
                                     : geometry::layers_to_made_stone(columns, geometry::kAutomaticStone);
    for (Vec3& node : mesh.nodes) node /= fruit.r1();
    for (Vec3& node : mesh.base) node /= fruit.r1();
    mesh.slow_functions = slow_functions_of(mesh);
    return mesh;
}

}  // namespace windfall::drying
