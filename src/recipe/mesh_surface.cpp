#include "recipe/mesh_surface.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "geometry/uv_check.h"
#include "meshfile/triangulate.h"

namespace windfall::recipe {
namespace {

/// The first texture coordinates of a mesh, by corner.
class TextureCoordinates {
  public:
    explicit TextureCoordinates(const meshfile::Mesh& mesh) : m_mesh(mesh) {
        for (const meshfile::Attribute& attribute : mesh.attributes)
            if (m_attribute == nullptr && attribute.role == meshfile::Role::TextureCoordinate &&
                attribute.components >= 2)
                m_attribute = &attribute;
        const bool gltf = mesh.source != nullptr && (mesh.source->format == meshfile::Format::Gltf ||
                                                     mesh.source->format == meshfile::Format::Glb);
        m_down = gltf;  // glTF 2.0, 3.8.3: v runs down
    }

    bool any() const { return m_attribute != nullptr; }

    geometry::Vec2 at(std::size_t corner) const {
        const std::int32_t entry =
            m_attribute->on_corners ? m_attribute->corner_entries[corner] : m_mesh.corners[corner];
        if (entry < 0) return geometry::Vec2::Constant(meshfile::kAbsent);
        const double* value =
            m_attribute->values.data() +
            static_cast<std::size_t>(entry) * static_cast<std::size_t>(m_attribute->components);
        return {value[0], m_down ? 1 - value[1] : value[1]};
    }

  private:
    const meshfile::Mesh& m_mesh;
    const meshfile::Attribute* m_attribute = nullptr;
    bool m_down = false;
};

}  // namespace

geometry::SurfaceMesh surface_of(const meshfile::Mesh& mesh) {
    geometry::SurfaceMesh surface;
    surface.positions = mesh.world_positions();
    const TextureCoordinates uvs(mesh);
    const auto add = [&](const std::vector<std::size_t>& corners) {
        geometry::Face face{0, 0, 0, geometry::kNoVertex};
        std::array<geometry::Vec2, 4> corner_uvs{};
        for (std::size_t k = 0; k < corners.size(); ++k) {
            face[k] = mesh.corners[corners[k]];
            corner_uvs[k] = uvs.any() ? uvs.at(corners[k]) : geometry::Vec2::Zero();
        }
        surface.faces.push_back(face);
        if (uvs.any()) surface.corner_uvs.push_back(corner_uvs);
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const bool mirrored = mesh.groups[static_cast<std::size_t>(mesh.faces[f].group)].mirrored();
        std::vector<std::vector<std::size_t>> pieces;
        if (mesh.corner_count(f) <= 4) {
            pieces.emplace_back();
            for (std::size_t c = mesh.face_starts[f]; c < mesh.face_starts[f + 1]; ++c)
                pieces.back().push_back(c);
        } else {
            for (const auto& triangle : meshfile::triangulated(mesh, f))
                pieces.emplace_back(triangle.begin(), triangle.end());
        }
        for (std::vector<std::size_t>& corners : pieces) {
            if (mirrored) std::reverse(corners.begin(), corners.end());
            add(corners);
        }
    }
    return surface;
}

void require_own_uvs(const geometry::SurfaceMesh& mesh, const std::string& name) {
    try {
        geometry::require_uvs(mesh, name);
    } catch (const InputError& error) {
        throw InputError(
            fmt::format("{}\nor set fruit.uvs = \"atlas\": the take then has a skin of its own in the mesh's "
                        "shape, with texture coordinates of its own",
                        error.what()));
    }
}

}  // namespace windfall::recipe
