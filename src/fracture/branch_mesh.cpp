#include "fracture/branch_mesh.h"

#include <Eigen/Geometry>

namespace windfall::fracture {

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
    const Vector3f* p = mesh.positions.data();
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
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
    for (Vector3f& n : mesh.normals) {
        const float square = n.squaredNorm();
        if (square > 0) n *= 1 / std::sqrt(square);
    }
}

}  // namespace windfall::fracture
