#pragma once
// The steps of surface_defects(): each adds what it finds.
#include <algorithm>
#include <string>
#include <vector>

#include "geometry/surface_check.h"
#include "geometry/surface_check_edges.h"

namespace windfall::geometry {

/// A surface, its edges and the defects found in it so far.
struct Examination {
    TriangleSurface surface;
    SurfaceEdges edges;
    std::vector<SurfaceDefect> defects;

    explicit Examination(const SurfaceMesh& mesh)
        : surface(welded_triangles(mesh)), edges(surface.triangles) {}

    Vec3 twice_area(std::int32_t t) const {
        const auto& [a, b, c] = surface.triangles[t];
        const auto& p = surface.positions;
        return (p[b] - p[a]).cross(p[c] - p[a]);
    }
    Vec3 centre(std::int32_t t) const {
        const auto& [a, b, c] = surface.triangles[t];
        return (surface.positions[a] + surface.positions[b] + surface.positions[c]) / 3;
    }
    Vec3 centre_of(const std::vector<std::int32_t>& triangles) const {
        Vec3 sum = Vec3::Zero();
        double areas = 0;
        for (const std::int32_t t : triangles) {
            sum += twice_area(t).norm() * centre(t);
            areas += twice_area(t).norm();
        }
        return areas > 0 ? Vec3(sum / areas) : centre(triangles[0]);
    }
    void add(SurfaceDefectKind kind, const Vec3& place_m, const std::vector<std::int32_t>& triangles,
             std::string text) {
        SurfaceDefect defect{kind, place_m, {}, std::move(text)};
        for (const std::int32_t t : triangles) defect.faces.push_back(surface.origin[t].face);
        std::sort(defect.faces.begin(), defect.faces.end());
        defect.faces.erase(std::unique(defect.faces.begin(), defect.faces.end()), defect.faces.end());
        defects.push_back(std::move(defect));
    }
    std::vector<std::int32_t> all_triangles() const {
        std::vector<std::int32_t> all(surface.triangles.size());
        std::iota(all.begin(), all.end(), 0);
        return all;
    }
};

/// "(x, y, z) m"
std::string place_text(const Vec3& place_m);

void find_degenerate(Examination& e);
void find_holes(Examination& e);
void find_fins(Examination& e);
/// Which triangles must be turned over for all of a patch to face one way: the smaller part by area.
std::vector<char> turned_over(const Examination& e);
void find_flipped(Examination& e, const std::vector<char>& turned);
void find_bow_ties(Examination& e);

/// Triangles of each body, the largest (by area) first.
std::vector<std::vector<std::int32_t>> bodies_of(const Examination& e);
void find_bodies(Examination& e, const std::vector<std::vector<std::int32_t>>& bodies);
/// Every edge must have two triangles, and no vertex two fans.
void find_handles(Examination& e, std::size_t bodies);
void find_inside_out(Examination& e, const std::vector<std::int32_t>& body, const std::vector<char>& turned);
void find_self_intersections(Examination& e);

}  // namespace windfall::geometry
