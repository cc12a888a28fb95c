#pragma once
// What every branch mesh must be.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/break_ends.h"

namespace windfall::test {

/// Edges of a mesh, from -> to, each packed in 64 bits.
inline std::vector<std::uint64_t> directed_edges(const std::vector<geometry::Face>& faces) {
    std::vector<std::uint64_t> edges;
    for (const geometry::Face& face : faces) {
        const int count = geometry::corner_count(face);
        for (int k = 0; k < count; ++k) {
            const auto a = static_cast<std::uint64_t>(face[static_cast<std::size_t>(k)]);
            const auto b = static_cast<std::uint64_t>(face[static_cast<std::size_t>((k + 1) % count)]);
            edges.push_back(a << 32U | b);
        }
    }
    return edges;
}

/// How many edges are not run through exactly once in each direction: 0 for a closed, manifold, oriented
/// mesh.
inline std::size_t bad_edges(const std::vector<geometry::Face>& faces) {
    std::vector<std::uint64_t> edges = directed_edges(faces);
    std::sort(edges.begin(), edges.end());
    std::size_t bad = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::uint64_t back = edges[i] << 32U | edges[i] >> 32U;
        if (i + 1 < edges.size() && edges[i] == edges[i + 1]) ++bad;
        if (!std::binary_search(edges.begin(), edges.end(), back)) ++bad;
    }
    return bad;
}

/// Empty when all is well, else the first thing that is not: sizes, indices, numbers, topology, volume.
inline std::string complaint_about(const fracture::BranchMesh& mesh) {
    const std::size_t vertices = mesh.positions.size(), faces = mesh.faces.size();
    if (vertices == 0 || faces == 0) return "empty";
    if (mesh.height.size() != vertices || mesh.thorn.size() != vertices || mesh.tissue.size() != vertices ||
        mesh.bundle.size() != vertices || mesh.normals.size() != vertices)
        return "vertex arrays differ in size";
    if (mesh.parts.size() != faces || mesh.corner_uvs.size() != faces || mesh.face_normals.size() != faces)
        return "face arrays differ in size";
    for (const auto& p : mesh.positions)
        if (!p.allFinite()) return "position not finite";
    for (const auto& n : mesh.normals)
        if (!n.allFinite()) return "normal not finite";
    for (const auto& n : mesh.face_normals)
        if (!(std::abs(n.norm() - 1) < 1e-4F)) return "face normal not of unit length";
    std::vector<int> smooth_part(vertices, -1);
    for (std::size_t f = 0; f < faces; ++f) {
        const int count = geometry::corner_count(mesh.faces[f]);
        for (int k = 0; k < count; ++k) {
            const std::int32_t v = mesh.faces[f][static_cast<std::size_t>(k)];
            if (v < 0 || static_cast<std::size_t>(v) >= vertices) return "index out of range";
            if (!mesh.corner_uvs[f][static_cast<std::size_t>(k)].allFinite()) return "uv not finite";
            if (!fracture::is_smooth(mesh.parts[f])) continue;
            int& part = smooth_part[static_cast<std::size_t>(v)];
            if (part >= 0 && part != static_cast<int>(mesh.parts[f])) return "vertex in two smooth parts";
            part = static_cast<int>(mesh.parts[f]);
        }
    }
    if (const std::size_t bad = bad_edges(mesh.faces); bad > 0) return std::to_string(bad) + " bad edges";
    return "";
}

/// Whether a cell of the broken surface is turned inside out in the plan. The branch must be straight.
inline bool has_inverted_cell(const fracture::BreakEnds& ends) {
    for (int r = 1; r < ends.cells.rings; ++r)
        for (int s = 0; s < ends.cells.sectors; ++s) {
            const auto& v = ends.cells.of(r, s);
            for (std::size_t k = 0; k < 4; ++k) {
                const auto at = [&](std::size_t i) {
                    const auto& p = ends.stub.positions[static_cast<std::size_t>(v[i & 3U])];
                    return Eigen::Vector2d(p.x(), p.y());
                };
                const Eigen::Vector2d a = at(k + 1) - at(k), b = at(k + 3) - at(k);
                if (!(a.x() * b.y() - a.y() * b.x() > 0)) return true;
            }
        }
    return false;
}

/// Volume of a closed mesh (signed).
inline double volume(const fracture::BranchMesh& mesh) {
    double six = 0;
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        const Eigen::Vector3d p = mesh.positions[static_cast<std::size_t>(a)].cast<double>();
        const Eigen::Vector3d q = mesh.positions[static_cast<std::size_t>(b)].cast<double>();
        const Eigen::Vector3d r = mesh.positions[static_cast<std::size_t>(c)].cast<double>();
        six += p.dot(q.cross(r));
    };
    for (const geometry::Face& f : mesh.faces) {
        add(f[0], f[1], f[2]);
        if (f[3] != geometry::kNoVertex) add(f[0], f[2], f[3]);
    }
    return six / 6;
}

/// Where a vertical line through (x, y) runs inside the mesh: [from, to] intervals of z by winding number.
inline std::vector<std::pair<double, double>> inside_along_z(const fracture::BranchMesh& mesh, double x,
                                                             double y) {
    std::vector<std::pair<double, int>> crossings;
    const auto cross = [&](std::int32_t ia, std::int32_t ib, std::int32_t ic) {
        const Eigen::Vector3d a = mesh.positions[static_cast<std::size_t>(ia)].cast<double>();
        const Eigen::Vector3d b = mesh.positions[static_cast<std::size_t>(ib)].cast<double>();
        const Eigen::Vector3d c = mesh.positions[static_cast<std::size_t>(ic)].cast<double>();
        const auto side = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
            return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
        };
        const double u = side(b, c), v = side(c, a), w = side(a, b);
        if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return;
        crossings.emplace_back((u * a.z() + v * b.z() + w * c.z()) / (u + v + w), u > 0 ? -1 : 1);
    };
    for (const geometry::Face& f : mesh.faces) {
        cross(f[0], f[1], f[2]);
        if (f[3] != geometry::kNoVertex) cross(f[0], f[2], f[3]);
    }
    std::sort(crossings.begin(), crossings.end());
    std::vector<std::pair<double, double>> intervals;
    int winding = 0;
    for (const auto& [z, step] : crossings) {
        if (winding <= 0 && winding + step > 0) intervals.emplace_back(z, z);
        if (winding > 0 && winding + step <= 0) intervals.back().second = z;
        winding += step;
    }
    return intervals;
}

/// Length that both meshes share along the vertical line through (x, y).
inline double overlap_along_z(const fracture::BranchMesh& a, const fracture::BranchMesh& b, double x,
                              double y) {
    double shared = 0;
    for (const auto& [a0, a1] : inside_along_z(a, x, y))
        for (const auto& [b0, b1] : inside_along_z(b, x, y))
            shared += std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
    return shared;
}

}  // namespace windfall::test
