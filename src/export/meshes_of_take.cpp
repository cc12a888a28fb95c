#include "export/meshes_of_take.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::export_ {
namespace {

using geometry::Face;
using geometry::Vec3;

constexpr double kWoodRoughness = 0.85;

const take::FrameMesh& mesh_of(const take::Frame& frame, const std::string& name) {
    for (const auto& mesh : frame.meshes)
        if (mesh.name == name) return mesh;
    throw InputError(fmt::format("frame {} has no mesh '{}'; make the take again", frame.index, name));
}

std::vector<Vec3> in_metres(const take::FrameMesh& mesh, double metres, int frame) {
    std::vector<Vec3> positions;
    positions.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions) {
        positions.emplace_back(metres * p.cast<double>());
        if (!positions.back().allFinite())
            throw InputError(fmt::format(
                "frame {} has vertices that are nowhere (not a number); make the take again", frame));
    }
    return positions;
}

bool is_unit(const Vec3& normal) { return std::abs(normal.norm() - 1) < 1e-6; }

/// Hard faces do not count at vertices that have smooth ones.
std::vector<Vec3> unit_normals(const std::vector<Vec3>& positions, const MeshToExport& mesh) {
    auto normals = geometry::vertex_normals(positions, mesh.faces);
    if (mesh.has_hard_faces()) {
        std::vector<Face> smooth;
        for (std::size_t f = 0; f < mesh.faces.size(); ++f)
            if (!mesh.materials[mesh.material_of(f)].hard) smooth.push_back(mesh.faces[f]);
        const auto smooth_normals = geometry::vertex_normals(positions, smooth);
        for (std::size_t v = 0; v < normals.size(); ++v)
            if (is_unit(smooth_normals[v])) normals[v] = smooth_normals[v];
    }
    // A vertex without area around it has no normal, and formats want unit vectors.
    for (Vec3& normal : normals)
        if (!is_unit(normal)) normal = Vec3::UnitY();
    return normals;
}

std::vector<Vec3> unit_face_normals(const MeshToExport& mesh) {
    std::vector<Vec3> normals;
    if (!mesh.has_hard_faces()) return normals;
    for (const Face& face : mesh.faces) {
        const auto at = [&](std::size_t k) -> const Vec3& {
            return mesh.positions[static_cast<std::size_t>(face[k])];
        };
        const std::size_t last = geometry::corner_count(face) == 3 ? 2 : 3;
        normals.push_back((at(2) - at(0)).cross(at(last) - at(1)).normalized());
        if (!is_unit(normals.back())) normals.back() = Vec3::UnitY();
    }
    return normals;
}

/// The plain part of a take's look; a look without these keys leaves a neutral grey.
ExportMaterial material_of_look(const nlohmann::json& look) {
    ExportMaterial material;
    if (!look.is_object()) return material;
    const auto colour = look.find("look.dry_colour");
    if (colour != look.end() && colour->is_array() && colour->size() == 3)
        for (std::size_t k = 0; k < 3; ++k)
            if ((*colour)[k].is_number())
                material.base_colour[k] = std::clamp(linear_from_srgb((*colour)[k].get<double>()), 0.0, 1.0);
    const auto roughness = look.find("look.roughness");
    if (roughness != look.end() && roughness->is_number())
        material.roughness = std::clamp(roughness->get<double>(), 0.0, 1.0);
    return material;
}

/// The mean colour of the corners of a material's faces.
std::array<double, 3> mean_colour(const MeshToExport& mesh, std::size_t material,
                                  const std::array<double, 3>& without) {
    const take::Attribute* colour = mesh.colour();
    if (colour == nullptr) return without;
    std::array<double, 3> sum{};
    double count = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (mesh.material_of(f) != material) continue;
        for (int c = 0; c < geometry::corner_count(mesh.faces[f]); ++c, ++count)
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] += colour->values[3 * static_cast<std::size_t>(mesh.faces[f][c]) + k];
    }
    if (count == 0) return without;
    for (double& part : sum) part = std::clamp(part / count, 0.0, 1.0);
    return sum;
}

void set_materials(MeshToExport& mesh, const take::TakeMesh& fresh, const nlohmann::json& look) {
    mesh.materials = {material_of_look(look)};
    mesh.materials[0].name = fresh.name;
    if (fresh.materials.empty()) return;
    mesh.face_materials = fresh.face_materials;
    mesh.materials.clear();
    for (const auto& material : fresh.materials) {
        ExportMaterial made;
        made.name = material.name;
        made.hard = material.hard;
        made.roughness = kWoodRoughness;
        mesh.materials.push_back(made);
    }
    for (std::size_t m = 0; m < mesh.materials.size(); ++m)
        mesh.materials[m].base_colour = mean_colour(mesh, m, mesh.materials[m].base_colour);
}

}  // namespace

std::vector<MeshToExport> meshes_at(const take::TakeReader& take, const take::Frame& frame, double metres) {
    std::vector<MeshToExport> meshes;
    for (const auto& fresh : take.meshes()) {
        if (fresh.rest.faces.empty()) continue;
        const auto& moved = mesh_of(frame, fresh.name);
        MeshToExport mesh;
        mesh.name = fresh.name;
        mesh.faces = fresh.rest.faces;
        mesh.corner_uvs = fresh.rest.corner_uvs;
        mesh.attributes = fresh.attributes;
        mesh.attributes.insert(mesh.attributes.end(), moved.attributes.begin(), moved.attributes.end());
        set_materials(mesh, fresh, take.info().look);
        mesh.positions = in_metres(moved, metres, frame.index);
        mesh.normals = unit_normals(mesh.positions, mesh);
        mesh.face_normals = unit_face_normals(mesh);
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

std::vector<MorphShape> shapes_at(const std::vector<MeshToExport>& meshes, const take::Frame& frame,
                                  double metres) {
    std::vector<MorphShape> shapes;
    for (const auto& mesh : meshes) {
        const auto positions = in_metres(mesh_of(frame, mesh.name), metres, frame.index);
        MorphShape shape;
        for (const Vec3& p : positions) shape.positions.emplace_back(p.cast<float>());
        for (const Vec3& n : unit_normals(positions, mesh)) shape.normals.emplace_back(n.cast<float>());
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

void keep_constant_attributes(const take::TakeReader& take, std::vector<MeshToExport>& meshes) {
    for (auto& mesh : meshes)
        for (const auto& fresh : take.meshes())
            if (fresh.name == mesh.name) mesh.attributes = fresh.attributes;
}

}  // namespace windfall::export_
