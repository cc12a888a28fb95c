#include "fracture/tree_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "meshfile/triangulate.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

struct PlaceHash {
    std::size_t operator()(const std::array<double, 3>& p) const {
        std::uint64_t hash = 0;
        for (const double x : p) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
        return hash ^ (hash >> 29U);
    }
};

void weld(const std::vector<Vec3>& world, TreeSurface& surface) {
    std::unordered_map<std::array<double, 3>, std::int32_t, PlaceHash> number;
    number.reserve(world.size());
    for (const Vec3& p : world) {
        // Adding 0 makes one of the two zeros.
        const std::array<double, 3> place{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
        const auto [found, is_new] =
            number.try_emplace(place, static_cast<std::int32_t>(surface.positions.size()));
        if (is_new) surface.positions.push_back(p);
        surface.welded.push_back(found->second);
    }
}

struct HalfEdge {
    std::int32_t low, high, triangle;
    std::uint8_t side;
    bool rising;
};

void find_neighbours(TreeSurface& surface) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::int32_t a = surface.triangles[t].vertices[k];
            const std::int32_t b = surface.triangles[t].vertices[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), k, a < b});
        }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
        return std::tie(x.low, x.high, x.triangle, x.side) < std::tie(y.low, y.high, y.triangle, y.side);
    });
    surface.neighbours.assign(surface.triangles.size(), {-1, -1, -1});
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high)
            ++end;
        if (end - i == 2 && edges[i].rising != edges[i + 1].rising) {
            const HalfEdge &x = edges[i], &y = edges[i + 1];
            surface.neighbours[static_cast<std::size_t>(x.triangle)][x.side] = y.triangle;
            surface.neighbours[static_cast<std::size_t>(y.triangle)][y.side] = x.triangle;
        }
        i = end;
    }
}

void find_components(TreeSurface& surface) {
    DisjointSets sets(surface.positions.size());
    for (const TreeTriangle& t : surface.triangles) {
        sets.join(t.vertices[0], t.vertices[1]);
        sets.join(t.vertices[0], t.vertices[2]);
    }
    surface.component.assign(surface.positions.size(), -1);
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        std::int32_t& of_root =
            surface.component[static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(v)))];
        if (of_root < 0) of_root = surface.components++;
        surface.component[v] = of_root;
    }
}

}  // namespace

DisjointSets::DisjointSets(std::size_t count) : m_parent(count) {
    std::iota(m_parent.begin(), m_parent.end(), 0);
}

std::int32_t DisjointSets::find(std::int32_t i) {
    auto parent = [&](std::int32_t k) -> std::int32_t& { return m_parent[static_cast<std::size_t>(k)]; };
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
}

void DisjointSets::join(std::int32_t i, std::int32_t j) {
    i = find(i);
    j = find(j);
    // The smaller number stands for the set, so that numbers do not depend on the order of joining.
    m_parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
}

Vec3 TreeSurface::twice_area(const TreeTriangle& t) const {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
}

TreeSurface make_tree_surface(const meshfile::Mesh& mesh) {
    TreeSurface surface;
    weld(mesh.world_positions(), surface);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const bool mirrored = mesh.groups[static_cast<std::size_t>(mesh.faces[f].group)].mirrored();
        for (std::array<std::size_t, 3> corners : meshfile::triangulated(mesh, f)) {
            if (mirrored) std::swap(corners[1], corners[2]);
            TreeTriangle triangle{{}, corners, static_cast<std::int32_t>(f)};
            for (std::size_t k = 0; k < 3; ++k)
                triangle.vertices[k] = surface.welded[static_cast<std::size_t>(mesh.corners[corners[k]])];
            const auto& v = triangle.vertices;
            if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) surface.triangles.push_back(triangle);
        }
    }
    find_neighbours(surface);
    find_components(surface);
    return surface;
}

SurfacePlace nearest_place(const TreeSurface& surface, std::int32_t triangle, const Vec3& p) {
    const TreeTriangle& t = surface.triangles[static_cast<std::size_t>(triangle)];
    const Vec3 &a = surface.corner(t, 0), &b = surface.corner(t, 1), &c = surface.corner(t, 2);
    const auto at = [&](double wa, double wb, double wc) {
        return SurfacePlace{triangle, Vec3(wa, wb, wc), wa * a + wb * b + wc * c};
    };
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
                 d6 = ac.dot(cp);
    if (d1 <= 0 && d2 <= 0) return at(1, 0, 0);
    if (d3 >= 0 && d4 <= d3) return at(0, 1, 0);
    if (d6 >= 0 && d5 <= d6) return at(0, 0, 1);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return at(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return at(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(0, 1 - w, w);
    }
    const double sum = va + vb + vc;
    return at(1 - (vb + vc) / sum, vb / sum, vc / sum);
}

SurfacePlace nearest_place(const TreeSurface& surface, const Vec3& point) {
    SurfacePlace best;
    double best_sq = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const SurfacePlace place = nearest_place(surface, static_cast<std::int32_t>(t), point);
        const double distance_sq = (place.position - point).squaredNorm();
        if (distance_sq >= best_sq) continue;
        best_sq = distance_sq;
        best = place;
    }
    return best;
}

}  // namespace windfall::fracture
