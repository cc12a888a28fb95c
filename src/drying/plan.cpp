#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "drying/artist_skin.h"
#include "drying/drying_course.h"
#include "drying/drying_process.h"
#include "drying/specimen.h"

namespace windfall::drying {

void check(const DryingParameters& p) {
    if (p.mesh.layers != 0 && p.mesh.layers != 8 && p.mesh.layers != 16)
        throw InputError(fmt::format("mesh.layers must be 0, 8 or 16, not {}", p.mesh.layers));
    if (p.mesh.n % 8 != 0)
        throw InputError(
            fmt::format("mesh.n must be a multiple of 8 (the multigrid halves it), not {}; the nearest is {}",
                        p.mesh.n, std::max<std::int64_t>(8, (p.mesh.n + 4) / 8 * 8)));
    if (p.mesh.growth > 0 && p.mesh.growth < 1)
        throw InputError(fmt::format("mesh.growth must be 0 or at least 1, not {}", p.mesh.growth));
    if (p.mesh.elongation > 0 && p.mesh.elongation < 1)
        throw InputError(fmt::format("mesh.elongation must be 0 or at least 1, not {}", p.mesh.elongation));
    if (p.imperfection.longest_wave <= p.imperfection.shortest_wave)
        throw InputError("imperfection.longest_wave must be larger than imperfection.shortest_wave");
    const double largest_factor = std::max({p.drying.radial, p.drying.meridional, p.drying.latitudinal});
    if (largest_factor <= 0)
        throw InputError(
            "nothing would shrink: make one of drying.radial, drying.meridional, drying.latitudinal "
            "larger than 0");
    if (p.drying.shrinkage * largest_factor >= 1)
        throw InputError(
            fmt::format("the flesh would shrink to nothing in one direction (shrinkage {} there): make "
                        "drying.shrinkage or drying.radial, meridional, latitudinal smaller",
                        p.drying.shrinkage * largest_factor));
    if (p.imperfection.kind == ImperfectionKind::Modes &&
        buckling_linearization(p).beyond * largest_factor >= 1)
        throw InputError(
            fmt::format("buckling modes cannot be linearised about shrinkage {:.3g}: set a smaller "
                        "imperfection.linearize_at, or a larger material.gamma",
                        buckling_linearization(p).at));
    for (const double shrinkage : p.output.shrinkages)
        if (shrinkage > p.drying.shrinkage)
            throw InputError(
                fmt::format("output.shrinkages holds {}, beyond the end of the drying: raise "
                            "drying.shrinkage (now {}) or take it out",
                            shrinkage, p.drying.shrinkage));
    check_moisture(p);
    if (p.fruit.mesh.empty()) {
        make_shape(p.fruit);
        return;
    }
    if (p.fruit.stone == StoneKind::Mesh && p.fruit.stone_mesh.empty())
        throw InputError("fruit.stone = \"mesh\" needs the file of the stone in fruit.stone_mesh");
}

namespace {

constexpr double kSameStop = 1e-9;  // rounding of even parts

/// `listed`, 0 and `end`, rising; with nothing listed, `count` even ones.
std::vector<double> frame_stops(std::vector<double> listed, std::int64_t count, double end) {
    if (listed.empty()) {
        for (std::int64_t i = 0; i < count; ++i)
            listed.push_back(end * static_cast<double>(i) / static_cast<double>(count - 1));
        return listed;
    }
    listed.push_back(0);
    listed.push_back(end);
    std::sort(listed.begin(), listed.end());
    listed.erase(
        std::unique(listed.begin(), listed.end(), [](double a, double b) { return b - a < kSameStop; }),
        listed.end());
    return listed;
}

/// The way up to `drying.shrinkage` and down again as far as the fruit is rewetted.
std::vector<double> way_stops(const DryingParameters& p) {
    const double most = p.drying.shrinkage;
    const double way = most * (1 + p.drying.rewet);
    if (p.drying.rewet == 0) return frame_stops(p.output.shrinkages, p.output.frames, most);
    std::vector<double> listed{most};  // the turn is always taken
    for (std::int64_t i = 0; p.output.shrinkages.empty() && i < p.output.frames; ++i)
        listed.push_back(way * static_cast<double>(i) / static_cast<double>(p.output.frames - 1));
    for (const double shrinkage : p.output.shrinkages) {
        listed.push_back(shrinkage);
        if (2 * most - shrinkage < way) listed.push_back(2 * most - shrinkage);
    }
    return frame_stops(listed, p.output.frames, way);
}

}  // namespace

std::vector<double> frame_shrinkages(const DryingParameters& p) {
    std::vector<double> stops = way_stops(p);
    for (double& stop : stops) stop = shrinkage_on_way(stop, p.drying.shrinkage);
    return stops;
}

std::vector<double> frame_parameters(const DryingParameters& p) {
    return p.moisture.on() ? frame_stops(p.output.hours, p.output.frames, p.moisture.hours) : way_stops(p);
}

namespace {

/// `edge`: mean edge on the surface of `columns` columns (r_1); `wanted_n`: cells for the edge that is
/// wanted.
Plan plan_of(const DryingParameters& parameters, const MeshPlan& mesh, std::int64_t columns, double edge,
             int wanted_n) {
    constexpr double kFewestPerWave = 8;
    constexpr double kCoarsestEdge = 0.9;  // edge over t_e: wrinkles are then 4 % too large
    Plan result;
    result.n = mesh.cells[0];
    result.n_axial = mesh.cells[1];
    result.layers = mesh.layers;
    result.unknowns = columns * 3 * mesh.layers;
    result.expected_wave_length = expected_wave_length(parameters);
    result.elements_per_wave = result.expected_wave_length / edge;
    const double thickness = parameters.fruit.skin_thickness;
    if (result.elements_per_wave < kFewestPerWave)
        result.warnings.push_back(fmt::format(
            "only {:.1f} elements to a wrinkle of the expected wave length {:.3g} r_1: set mesh.n = {}",
            result.elements_per_wave, result.expected_wave_length, wanted_n));
    else if (edge > kCoarsestEdge * thickness)
        result.warnings.push_back(fmt::format(
            "elements are {:.2f} skin thicknesses wide, too coarse for the skin's bending: set mesh.n = {}",
            edge / thickness, wanted_n));
    if (mesh.skin_layers < 2)
        result.warnings.emplace_back(
            "one layer of elements in the skin is too soft in bending: set mesh.skin_layers = 2");
    if (result.expected_wave_length > 1.5)
        result.warnings.emplace_back(
            "the expected wrinkles are as large as the fruit: make fruit.skin_thickness or "
            "material.gamma smaller");
    return result;
}

/// The edge that warnings recommend, whatever the recipe asks for.
double recommended_edge(DryingParameters parameters) {
    parameters.mesh.edge_over_te = MeshParameters{}.edge_over_te;
    return wanted_edge(parameters);
}

}  // namespace

Plan plan(const DryingParameters& parameters) {
    check(parameters);
    const auto shape = make_shape(parameters.fruit);
    const MeshPlan mesh = plan_mesh(parameters, *shape);
    const geometry::BrickSurface brick = geometry::make_brick_surface(mesh.cells);
    std::vector<geometry::Vec3> points = geometry::brick_directions(brick, shape->half_extents());
    for (auto& point : points) point *= shape->flesh_radius(point);
    const double edge = geometry::edge_statistics(points, brick.quads).mean;
    const int wanted_n =
        geometry::brick_for_edge(*shape, recommended_edge(parameters), parameters.mesh.elongation)[0];
    return plan_of(parameters, mesh, static_cast<std::int64_t>(points.size()), edge, wanted_n);
}

Plan plan(const DryingParameters& parameters, const ArtistFruit& fruit) {
    check(parameters);
    const MeshPlan mesh = plan_mesh(parameters, fruit);
    const auto [n, m_n, same] = mesh.cells;
    const std::int64_t quads =
        2 * (std::int64_t{n} * m_n + std::int64_t{m_n} * same + std::int64_t{same} * n);
    const double area = fruit.surface().area() / (fruit.r1() * fruit.r1());
    const int wanted_n = geometry::cells_for(area, recommended_edge(parameters), fruit.elongation());
    // A closed surface of quadrilaterals has two vertices more than faces.
    Plan result =
        plan_of(parameters, mesh, quads + 2, std::sqrt(area / static_cast<double>(quads)), wanted_n);
    const auto add = [&](const std::vector<std::string>& warnings) {
        result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    };
    add(check_thickness(fruit.mesh(), parameters.fruit));
    if (parameters.fruit.uvs == TakeSkin::Own) add(check_resolution(fruit, result.expected_wave_length));
    return result;
}

}  // namespace windfall::drying
