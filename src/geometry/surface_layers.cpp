#include "geometry/surface_layers.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/medial_radius.h"
#include "geometry/sphere_map_interior.h"
#include "geometry/stone_lines.h"
#include "geometry/surface_check_finders.h"

namespace windfall::geometry {

namespace {

using Neighbours = std::vector<std::vector<std::int32_t>>;

Neighbours neighbours_along_edges(const BrickSurface& brick) {
    Neighbours result(brick.vertex_count());
    for (const Quad& quad : brick.quads)
        for (int c = 0; c < 4; ++c) result[quad[c]].push_back(quad[(c + 1) % 4]);
    // At the brick's corners and elsewhere alike each edge has two quadrilaterals, one for each way.
    return result;
}

std::vector<Vec3> smoothed_normals(const LaidBrick& laid, const Neighbours& neighbours) {
    constexpr int kTimes = 3;
    const std::vector<Quad>& quads = laid.brick.quads;
    std::vector<Vec3> normals = vertex_normals(laid.positions(), {quads.begin(), quads.end()});
    for (int k = 0; k < kTimes; ++k) {
        std::vector<Vec3> next = normals;
        for (std::size_t v = 0; v < next.size(); ++v) {
            for (const std::int32_t w : neighbours[v]) next[v] += normals[w];
            next[v].normalize();
        }
        normals = std::move(next);
    }
    return normals;
}

/// Lowers values until none is above a neighbour's by more than `slope` times the way there.
void limit_slope(std::vector<double>& values, double slope, const std::vector<Vec3>& points,
                 const Neighbours& neighbours) {
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t v = 0; v < values.size(); ++v) queue.push({values[v], static_cast<std::int32_t>(v)});
    while (!queue.empty()) {
        const auto [value, v] = queue.top();
        queue.pop();
        if (value > values[v]) continue;
        for (const std::int32_t w : neighbours[v]) {
            const double bound = value + slope * (points[v] - points[w]).norm();
            if (bound >= values[w]) continue;
            values[w] = bound;
            queue.push({bound, w});
        }
    }
}

std::vector<double> smooth_medial_radii(const SurfaceColumns& columns, const std::vector<Vec3>& normals,
                                        const Neighbours& neighbours) {
    constexpr int kEvery = 4;  // lines of the lattice
    constexpr double kSlope = 0.3;
    constexpr int kSmoothings = 10;
    constexpr std::size_t kLayerVerticesPerTask = 16;
    const std::vector<Vec3> points = columns.laid.positions();
    const double largest = diagonal_of(points);
    std::vector<double> own(points.size(), largest);
    parallel_blocks(points.size(), kLayerVerticesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Lattice& lattice = columns.laid.brick.lattice[v];
            if (std::any_of(lattice.begin(), lattice.end(), [](int i) { return i % kEvery != 0; })) continue;
            own[v] =
                medial_radius(columns.surface.tree(), points[v], normals[v], largest, columns.skin_thickness);
        }
    });
    std::vector<double> radii = own;
    limit_slope(radii, kSlope, points, neighbours);
    for (int k = 0; k < kSmoothings; ++k) {
        std::vector<double> next = radii;
        for (std::size_t v = 0; v < radii.size(); ++v) {
            double sum = radii[v];
            for (const std::int32_t w : neighbours[v]) sum += radii[w];
            next[v] = std::min(own[v], sum / static_cast<double>(neighbours[v].size() + 1));
        }
        radii = std::move(next);
    }
    return radii;
}

LayeredMesh layered(const SurfaceColumns& columns, const std::vector<Vec3>& outward,
                    const std::vector<Vec3>& stone) {
    LayeredMesh mesh;
    mesh.brick = columns.laid.brick;
    mesh.layers = columns.fractions.count();
    mesh.flesh_layers = static_cast<int>(columns.fractions.flesh.size());
    mesh.directions = columns.directions;
    mesh.outward = outward;
    mesh.base = stone;
    mesh.nodes.reserve(stone.size() * static_cast<std::size_t>(mesh.layers));
    for (std::size_t c = 0; c < stone.size(); ++c) {
        const Vec3 skin = columns.skin_thickness * outward[c];
        const Vec3 flesh_top = columns.laid.spots[c].point - skin;
        double share = 0;
        for (const double fraction : columns.fractions.flesh) {
            share += fraction;
            mesh.nodes.emplace_back(stone[c] + share * (flesh_top - stone[c]));
        }
        share = 0;
        for (const double fraction : columns.fractions.skin) {
            share += fraction;
            mesh.nodes.emplace_back(flesh_top + share * skin);
        }
    }
    return mesh;
}

/// The best of several meshes of one body.
struct Soundest {
    LayeredMesh mesh;
    WorstCorner worst;

    /// Gives whether no more need be tried.
    bool take(LayeredMesh other) {
        constexpr double kSound = 0.15;  // scaled Jacobian
        const WorstCorner its = worst_corner(other);
        if (mesh.nodes.empty() || its.scaled_jacobian > worst.scaled_jacobian) {
            mesh = std::move(other);
            worst = its;
        }
        return worst.scaled_jacobian > kSound;
    }
};

[[noreturn]] void refuse_fold(const WorstCorner& worst, const char* remedy) {
    throw InputError(fmt::format("the layers of the mesh fold over near {} of its file: {}",
                                 place_text(worst.place), remedy));
}

}  // namespace

LayeredMesh layers_to_made_stone(const SurfaceColumns& columns, const MadeStone& stone) {
    constexpr double kShallowest = 1.8;  // skins: no stone lies higher
    const Neighbours neighbours = neighbours_along_edges(columns.laid.brick);
    const std::vector<Vec3> outward = smoothed_normals(columns.laid, neighbours);
    const std::vector<double> radii = smooth_medial_radii(columns, outward, neighbours);
    Soundest soundest;
    for (const double share : stone.shares) {
        std::vector<Vec3> ends(outward.size());
        for (std::size_t v = 0; v < ends.size(); ++v)
            ends[v] = columns.laid.spots[v].point -
                      std::max(share * radii[v], kShallowest * columns.skin_thickness) * outward[v];
        if (soundest.take(layered(columns, outward, ends))) break;
    }
    if (!(soundest.worst.scaled_jacobian > 0))
        refuse_fold(soundest.worst, "smooth the surface around it, or make fruit.skin_thickness smaller");
    return std::move(soundest.mesh);
}

LayeredMesh layers_to_core(const SurfaceColumns& columns, const SphereMap& map) {
    constexpr double kCore = 0.25;  // of the way out
    const std::vector<Vec3> outward =
        smoothed_normals(columns.laid, neighbours_along_edges(columns.laid.brick));
    try {
        const SphereInterior interior(map);
        std::vector<Vec3> core;
        core.reserve(outward.size());
        for (const Vec3& direction : columns.directions) core.push_back(interior.point(direction, kCore));
        Soundest soundest;
        if (soundest.take(layered(columns, outward, core))) return std::move(soundest.mesh);
    } catch (const InputError&) {
        // No lines to a centre: the medial radius needs none.
    }
    return layers_to_made_stone(columns, kSmallCore);
}

LayeredMesh layers_to_stone(const SurfaceColumns& columns, const CurvedSurface& stone) {
    const Neighbours neighbours = neighbours_along_edges(columns.laid.brick);
    const std::vector<Vec3> outward = smoothed_normals(columns.laid, neighbours);
    Soundest soundest;
    // The light ones suit stones of the fruit's own shape, the last one others.
    for (const StoneRelaxation& relaxation : {StoneRelaxation{0, 5}, {10, 5}, {0, 0}, {50, 15}}) {
        const LaidBrick on_stone = brick_on_stone(columns.surface, columns.laid, stone, relaxation);
        if (soundest.take(layered(columns, outward, on_stone.positions()))) break;
    }
    if (!(soundest.worst.scaled_jacobian > 0))
        refuse_fold(soundest.worst,
                    "make the stone smaller or smoother there, or set fruit.stone = \"made\"");
    return std::move(soundest.mesh);
}

}  // namespace windfall::geometry
