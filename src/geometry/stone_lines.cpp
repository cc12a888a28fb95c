#include "geometry/stone_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/surface_check_finders.h"

namespace windfall::geometry {

namespace {

/// Where the line of steepest descent from a point of the skin ends on the stone.
SurfaceSpot end_of_line(const CurvedSurface& surface, const SurfaceSpot& start, const CurvedSurface& stone) {
    constexpr int kSteps = 200;
    constexpr double kStep = 0.1, kArrived = 0.02;  // of the thickness of the flesh
    const double thickness = (stone.tree().nearest(start.point).point - start.point).norm();
    Vec3 x = start.point - kStep * thickness * start.normal;
    for (int k = 0; k < kSteps; ++k) {
        const Vec3 from_skin = x - surface.tree().nearest(x).point;
        const Vec3 to_stone = stone.tree().nearest(x).point - x;
        const double d_skin = from_skin.norm(), d_stone = to_stone.norm();
        if (!(d_stone > kArrived * thickness) || !(d_skin > 0)) break;
        // -grad(d_stone / (d_skin + d_stone)), times the square of the sum.
        const Vec3 downhill = d_skin * (to_stone / d_stone) + d_stone * (from_skin / d_skin);
        const double length = downhill.norm();
        if (!(length > 1e-6 * (d_skin + d_stone))) break;
        x += std::min(kStep * thickness, d_stone) / length * downhill;
    }
    return stone.nearest(x);
}

}  // namespace

LaidBrick brick_on_stone(const CurvedSurface& surface, const LaidBrick& laid, const CurvedSurface& stone,
                         const StoneRelaxation& relaxation) {
    constexpr int kFewestCells = 6;
    constexpr std::size_t kMostLevels = 3;
    std::vector<Lattice> levels{laid.brick.cells};
    while (levels.size() < kMostLevels && can_coarsen(levels.back()) &&
           *std::min_element(levels.back().begin(), levels.back().end()) >= 2 * kFewestCells)
        levels.push_back(coarser(levels.back()));
    const int stride = 1 << (levels.size() - 1);
    LaidBrick on_stone{make_brick_surface(levels.back()), {}};
    on_stone.spots.resize(on_stone.brick.vertex_count());
    parallel_blocks(on_stone.spots.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            Lattice point = on_stone.brick.lattice[v];
            for (int& i : point) i *= stride;
            on_stone.spots[v] = end_of_line(surface, laid.spots[laid.brick.vertex_at(point)], stone);
        }
    });
    for (std::size_t level = levels.size(); level-- > 0;) {
        const bool coarsest = level + 1 == levels.size();
        if (!coarsest) on_stone = refined(stone, on_stone, make_brick_surface(levels[level]));
        for (const double barrier : {0.5, 0.2, 0.05})
            relax(stone, on_stone, {coarsest ? relaxation.coarsest : relaxation.finer, barrier});
    }
    return on_stone;
}

void require_inside(const CurvedSurface& surface, const CurvedSurface& stone, double distance) {
    double highest = -std::numeric_limits<double>::infinity();  // over the skin
    Vec3 place = Vec3::Zero();
    for (const Vec3& p : stone.triangles().positions) {
        const TriangleTree::Nearest nearest = surface.tree().nearest(p);
        const bool outside = surface.at(nearest.place).normal.dot(p - nearest.point) > 0;
        const double height = (outside ? 1 : -1) * std::sqrt(nearest.distance_sq);
        if (height <= highest) continue;
        highest = height;
        place = p;
    }
    if (highest <= -distance) return;
    throw InputError(
        fmt::format("the stone {} near {} of the mesh's file: make it smaller there, or set fruit.stone = "
                    "\"made\"",
                    highest > 0 ? "pierces the skin" : "comes too close to the skin", place_text(place)));
}

}  // namespace windfall::geometry
