#include "geometry/laid_brick.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geometry/layered_mesh.h"
#include "geometry/sphere_map_areas.h"

namespace windfall::geometry {

namespace {

constexpr int kFewestCoarseCells = 6;  // fewer, and a quadrilateral swallows a neck

/// A rotation that takes y to the line between the surface's ends as they lie on the sphere.
Eigen::Matrix3d along_the_ends(const SphereMap& map) {
    const auto [one, other] = ends_of(map.surface());
    const Vec3 axis = (map.directions()[one] - map.directions()[other]).normalized();
    const Vec3 across = std::abs(axis.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitZ();
    Eigen::Matrix3d frame;
    frame.col(1) = axis;
    frame.col(2) = across.cross(axis).normalized();
    frame.col(0) = frame.col(1).cross(frame.col(2));
    return frame;
}

LaidBrick laid_by_map(const CurvedSurface& surface, const SphereMap& map, const Lattice& cells) {
    LaidBrick laid{make_brick_surface(cells), {}};
    const Eigen::Matrix3d frame = along_the_ends(map);
    // On the sphere, where areas are even, the ends of a long brick have their share of it.
    const double length = std::sqrt(static_cast<double>(cells[1]) / cells[0]);
    for (const Vec3& direction : brick_directions(laid.brick, {1, length, 1}))
        laid.spots.push_back(surface.at(map.place(frame * direction)));
    return laid;
}

void unfold_and_relax(const CurvedSurface& surface, LaidBrick& laid, int sweeps) {
    for (const double barrier : {0.5, 0.2, 0.05}) relax(surface, laid, {sweeps, barrier});
}

}  // namespace

std::vector<Vec3> LaidBrick::positions() const {
    std::vector<Vec3> result;
    result.reserve(spots.size());
    for (const SurfaceSpot& spot : spots) result.push_back(spot.point);
    return result;
}

LaidBrick refined(const CurvedSurface& surface, const LaidBrick& coarse, const BrickSurface& fine) {
    LaidBrick laid{fine, {}};
    const double edge = std::sqrt(surface.area() / static_cast<double>(coarse.brick.quads.size()));
    for (const Parents& parents : brick_parents(fine, coarse.brick)) {
        if (parents.count == 1) {
            laid.spots.push_back(coarse.spots[parents.vertex[0]]);
            continue;
        }
        Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
        for (int k = 0; k < parents.count; ++k) {
            middle += coarse.spots[parents.vertex[k]].point / parents.count;
            normal += coarse.spots[parents.vertex[k]].normal;
        }
        SurfaceSpot spot = surface.nearest(middle, normal, 2 * edge);
        if (spot.place.triangle < 0) spot = surface.nearest(middle);
        laid.spots.push_back(spot);
    }
    return laid;
}

LaidBrick lay_brick(const CurvedSurface& surface, const SphereMap& map, const Lattice& cells) {
    // On the coarsest brick, with each of three barriers: what is uneven from end to end of a long one, which
    // has up to 66 cells there, takes about the square of a third of that to go.
    constexpr int kCoarsestSweeps = 300;
    constexpr int kSweeps = 60, kFinestSweeps = 50;
    std::vector<Lattice> levels{cells};
    while (can_coarsen(levels.back()) &&
           *std::min_element(levels.back().begin(), levels.back().end()) >= 2 * kFewestCoarseCells)
        levels.push_back(coarser(levels.back()));
    LaidBrick laid = laid_by_map(surface, map, levels.back());
    unfold_and_relax(surface, laid, kCoarsestSweeps);
    for (std::size_t level = 1; level < levels.size(); ++level) {
        laid = refined(surface, laid, make_brick_surface(levels[levels.size() - 1 - level]));
        relax(surface, laid, {level + 1 < levels.size() ? kSweeps : kFinestSweeps, 0.05});
    }
    return laid;
}

double best_elongation(const CurvedSurface& surface, const SphereMap& map) {
    constexpr int kQuads = 700;
    constexpr int kSweeps = 25;
    double best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (const double elongation : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0}) {
        const int n =
            std::max(4, 2 * static_cast<int>(std::lround(std::sqrt(kQuads / (2 + 4 * elongation)) / 2)));
        LaidBrick laid = laid_by_map(surface, map, {n, static_cast<int>(std::lround(elongation * n)), n});
        unfold_and_relax(surface, laid, kSweeps);
        const double deviation = edge_statistics(laid.positions(), laid.brick.quads).deviation_of_log;
        // Rounding shall not choose, nor a hair's breadth a longer brick.
        if (deviation > 0.99 * least) {
            // Once past the best length it only gets worse.
            if (deviation > 1.3 * least) break;
            continue;
        }
        least = deviation;
        best = elongation;
    }
    return best;
}

}  // namespace windfall::geometry
