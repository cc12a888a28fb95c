#pragma once
// What tests ask of meshes, apart from the code that made them.
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "meshfile/mesh.h"
#include "meshfile/triangulate.h"

namespace windfall::test {

using meshfile::Mesh;
using meshfile::Vec3;

/// Triangles in the world, counter-clockwise from outside.
inline std::vector<std::array<Vec3, 3>> world_triangles(const Mesh& mesh) {
    std::vector<std::array<Vec3, 3>> result;
    const std::vector<Vec3> world = mesh.world_positions();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const bool mirrored = mesh.groups[static_cast<std::size_t>(mesh.faces[f].group)].mirrored();
        for (const auto& corners : meshfile::triangulated(mesh, f)) {
            std::array<Vec3, 3> triangle;
            for (std::size_t k = 0; k < 3; ++k)
                triangle[k] = world[static_cast<std::size_t>(mesh.corners[corners[k]])];
            if (mirrored) std::swap(triangle[1], triangle[2]);
            result.push_back(triangle);
        }
    }
    return result;
}

/// Edges that are not run through once each way, where places are welded: 0 for a closed, manifold, oriented
/// surface.
inline std::size_t bad_edges(const Mesh& mesh) {
    using Place = std::array<double, 3>;
    std::map<Place, int> number;
    std::map<std::pair<int, int>, int> count;
    for (const auto& triangle : world_triangles(mesh)) {
        std::array<int, 3> v{};
        for (std::size_t k = 0; k < 3; ++k)
            v[k] = number.try_emplace({triangle[k].x(), triangle[k].y(), triangle[k].z()}, number.size())
                       .first->second;
        for (std::size_t k = 0; k < 3; ++k) ++count[{v[k], v[(k + 1) % 3]}];
    }
    std::size_t bad = 0;
    for (const auto& [edge, times] : count) {
        const auto back = count.find({edge.second, edge.first});
        if (times != 1 || back == count.end() || back->second != 1) ++bad;
    }
    return bad;
}

inline double volume(const Mesh& mesh) {
    double six = 0;
    for (const auto& t : world_triangles(mesh)) six += t[0].dot(t[1].cross(t[2]));
    return six / 6;
}

/// How often a closed surface winds about a point: 1 inside, 0 outside (Van Oosterom and Strackee 1983).
inline double winding(const std::vector<std::array<Vec3, 3>>& triangles, const Vec3& p) {
    double sum = 0;
    for (const auto& t : triangles) {
        const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

inline constexpr double kNothing = 1e300;

/// All that a file says of a face: places and values of its corners, material and group.
inline std::vector<double> content_of_face(const Mesh& mesh, std::size_t face) {
    std::vector<double> content{static_cast<double>(mesh.faces[face].material),
                                static_cast<double>(mesh.faces[face].group),
                                static_cast<double>(mesh.faces[face].smoothing)};
    for (std::size_t c = mesh.face_starts[face]; c < mesh.face_starts[face + 1]; ++c) {
        const Vec3& p = mesh.positions[static_cast<std::size_t>(mesh.corners[c])];
        content.insert(content.end(), p.begin(), p.end());
        std::vector<double> values(mesh.values_per_corner());
        meshfile::corner_values(mesh, c, values.data());
        for (double& value : values)
            if (value != value) value = kNothing;  // what is absent shall equal what is absent
        content.insert(content.end(), values.begin(), values.end());
    }
    return content;
}

/// The faces of `part` that are faces of `whole`, in order, from the first one on: gives their numbers there.
/// `values` of them are looked at (a part may have attributes that the whole has not).
inline std::vector<std::size_t> faces_taken_over(const Mesh& whole, const Mesh& part) {
    std::vector<std::size_t> taken;
    for (std::size_t f = 0; f < whole.face_count() && taken.size() < part.face_count(); ++f) {
        const std::vector<double> a = content_of_face(whole, f), b = content_of_face(part, taken.size());
        const std::size_t more = part.values_per_corner() - whole.values_per_corner();
        const std::size_t corners = whole.corner_count(f);
        if (b.size() != a.size() + more * corners) continue;
        const std::size_t width = 3 + whole.values_per_corner();
        bool same = std::equal(a.begin(), a.begin() + 3, b.begin());
        for (std::size_t c = 0; c < corners && same; ++c)
            same = std::equal(a.begin() + static_cast<std::ptrdiff_t>(3 + c * width),
                              a.begin() + static_cast<std::ptrdiff_t>(3 + (c + 1) * width),
                              b.begin() + static_cast<std::ptrdiff_t>(3 + c * (width + more)));
        if (same) taken.push_back(f);
    }
    return taken;
}

}  // namespace windfall::test
