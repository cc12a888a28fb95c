#include "fracture/branch_mesh.h"

#include <Eigen/Geometry>
#include <cmath>

namespace windfall::fracture {

namespace {

void normalize(Vector3f& n) {
    const float square = n.squaredNorm();
    if (square > 0) n *= 1 / std::sqrt(square);
}

/// Normals of the faces for which `wanted` says so; those of smooth ones go to their vertices, by area.
template <class Wanted>
void add_face_normals(BranchMesh& mesh, const Wanted& wanted) {
    const Vector3f* p = mesh.positions.data();
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (!wanted(f)) continue;
        const geometry::Face& face = mesh.faces[f];
        const bool triangle = face[3] == geometry::kNoVertex;
        const Vector3f normal = triangle ? Vector3f((p[face[1]] - p[face[0]]).cross(p[face[2]] - p[face[0]]))
                                         : Vector3f((p[face[2]] - p[face[0]]).cross(p[face[3]] - p[face[1]]));
        if (is_smooth(mesh.parts[f])) {
            mesh.normals[static_cast<std::size_t>(face[0])] += normal;
            mesh.normals[static_cast<std::size_t>(face[1])] += normal;
            mesh.normals[static_cast<std::size_t>(face[2])] += normal;
            if (!triangle) mesh.normals[static_cast<std::size_t>(face[3])] += normal;
        }
        const float square = normal.squaredNorm();
        mesh.face_normals[f] = square > 0 ? Vector3f(normal * (1 / std::sqrt(square))) : Vector3f::UnitZ();
    }
}

}  // namespace

const std::vector<std::string>& part_names() {
    static const std::vector<std::string> names{"bark",   "end_grain",  "fibres",
                                                "thorns", "inner_bark", "crack"};
    return names;
}

void BranchMesh::clear() {
    positions.clear();
    normals.clear();
    height.clear();
    thorn.clear();
    tissue.clear();
    bundle.clear();
    faces.clear();
    parts.clear();
    corner_uvs.clear();
    face_normals.clear();
}

void append(BranchMesh& mesh, const BranchMesh& other) {
    const auto shift = static_cast<std::int32_t>(mesh.positions.size());
    const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    add(mesh.positions, other.positions);
    add(mesh.normals, other.normals);
    add(mesh.height, other.height);
    add(mesh.thorn, other.thorn);
    add(mesh.tissue, other.tissue);
    add(mesh.bundle, other.bundle);
    add(mesh.parts, other.parts);
    add(mesh.corner_uvs, other.corner_uvs);
    add(mesh.face_normals, other.face_normals);
    for (geometry::Face face : other.faces) {
        for (std::int32_t& v : face)
            if (v != geometry::kNoVertex) v += shift;
        mesh.faces.push_back(face);
    }
}

void compute_normals(BranchMesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), Vector3f::Zero());
    mesh.face_normals.resize(mesh.faces.size());
    add_face_normals(mesh, [](std::size_t) { return true; });
    for (Vector3f& n : mesh.normals) normalize(n);
}

void compute_reverse_normals(const BranchMesh& mesh, std::size_t shared_vertices, std::size_t shared_faces,
                             const Vector3f& turned, BranchMesh& reverse) {
    const auto same = [&](std::int32_t v) {
        const auto i = static_cast<std::size_t>(v);
        return i < shared_vertices && mesh.height[i] == reverse.height[i];
    };
    const Vector3f sign = -turned;
    reverse.normals.assign(reverse.positions.size(), Vector3f::Zero());
    reverse.face_normals.resize(reverse.faces.size());
    add_face_normals(reverse, [&](std::size_t f) {
        const geometry::Face& face = reverse.faces[f];
        if (f >= shared_faces || !same(face[0]) || !same(face[1]) || !same(face[2]) ||
            (face[3] != geometry::kNoVertex && !same(face[3])))
            return true;
        reverse.face_normals[f] = sign.cwiseProduct(mesh.face_normals[f]);
        return false;
    });
    for (std::size_t v = 0; v < reverse.normals.size(); ++v) {
        if (same(static_cast<std::int32_t>(v)))
            reverse.normals[v] = sign.cwiseProduct(mesh.normals[v]);
        else
            normalize(reverse.normals[v]);
    }
}

}  // namespace windfall::fracture
