#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
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
    make_shape(p.fruit);
}

std::vector<double> frame_shrinkages(const DryingParameters& p) {
    const double most = p.drying.shrinkage;
    const double last = most * (1 - p.drying.rewet);
    std::vector<double> up = {0, most};
    std::vector<double> down;
    if (p.drying.rewet > 0) down.push_back(last);
    if (p.output.shrinkages.empty()) {
        const double way = most * (1 + p.drying.rewet);
        for (std::int64_t i = 0; i < p.output.frames; ++i) {
            const double part = way * static_cast<double>(i) / static_cast<double>(p.output.frames - 1);
            (part <= most ? up : down).push_back(part <= most ? part : 2 * most - part);
        }
    }
    for (const double shrinkage : p.output.shrinkages) {
        up.push_back(shrinkage);
        if (p.drying.rewet > 0 && shrinkage > last) down.push_back(shrinkage);
    }
    const auto in_order = [](std::vector<double>& values) {
        constexpr double kSame = 1e-9;  // rounding of the even parts
        std::sort(values.begin(), values.end());
        values.erase(
            std::unique(values.begin(), values.end(), [](double a, double b) { return b - a < kSame; }),
            values.end());
    };
    in_order(up);
    down.push_back(most);
    in_order(down);
    up.insert(up.end(), down.rbegin() + 1, down.rend());
    return up;
}

Plan plan(const DryingParameters& parameters) {
    constexpr double kFewestPerWave = 8;
    constexpr double kCoarsestEdge = 0.9;  // edge over t_e: wrinkles are then 4 % too large
    check(parameters);
    const auto shape = make_shape(parameters.fruit);
    const MeshPlan mesh = plan_mesh(parameters, *shape);
    const geometry::BrickSurface brick = geometry::make_brick_surface(mesh.cells);
    std::vector<geometry::Vec3> points = geometry::brick_directions(brick, shape->half_extents());
    for (auto& point : points) point *= shape->flesh_radius(point);
    const double edge = geometry::edge_statistics(points, brick.quads).mean;

    Plan result;
    result.n = mesh.cells[0];
    result.n_axial = mesh.cells[1];
    result.layers = mesh.layers;
    result.unknowns = static_cast<std::int64_t>(points.size()) * 3 * mesh.layers;
    result.expected_wave_length = expected_wave_length(parameters);
    result.elements_per_wave = result.expected_wave_length / edge;
    const double thickness = parameters.fruit.skin_thickness;
    const double wanted_edge = std::min(0.75 * thickness, result.expected_wave_length / 10);
    const int wanted_n = geometry::brick_for_edge(*shape, wanted_edge, parameters.mesh.elongation)[0];
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

}  // namespace windfall::drying
