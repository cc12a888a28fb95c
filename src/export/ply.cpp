#include "export/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

namespace windfall::export_ {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <class T>
void append(std::vector<std::byte>& bytes, T number) {
    const auto raw = std::as_bytes(std::span(&number, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// What the one list of vertices and the one list of faces have in common.
struct PlyLayout {
    std::vector<std::string> attributes;  ///< float properties, by their names in the meshes
    bool colours = false, uvs = false, meshes = false;
    std::vector<std::string> materials;  ///< of all meshes, each name once; empty: the faces do not say

    explicit PlyLayout(std::span<const MeshToExport> all) {
        const auto everywhere = [&](const auto& holds) { return std::all_of(all.begin(), all.end(), holds); };
        colours = everywhere([](const auto& mesh) { return mesh.colour() != nullptr; });
        uvs = everywhere([](const auto& mesh) { return !mesh.corner_uvs.empty(); });
        meshes = all.size() > 1;
        for (const auto& attribute : all.front().attributes)
            if (!(colours && &attribute == all.front().colour()) && everywhere([&](const auto& mesh) {
                    const auto* found = attribute_of(mesh, attribute.name);
                    return found != nullptr && found->components == attribute.components;
                }))
                attributes.push_back(attribute.name);
        if (std::all_of(all.begin(), all.end(), [](const auto& mesh) { return mesh.face_materials.empty(); }))
            return;
        for (const auto& mesh : all)
            for (const auto& material : mesh.materials)
                if (std::find(materials.begin(), materials.end(), material.name) == materials.end())
                    materials.push_back(material.name);
    }

    static const take::Attribute* attribute_of(const MeshToExport& mesh, const std::string& name) {
        for (const auto& attribute : mesh.attributes)
            if (attribute.name == name) return &attribute;
        return nullptr;
    }
};

std::string header(std::span<const MeshToExport> meshes, const PlyLayout& layout) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment Windfall; metres, Y up\n";
    for (std::size_t m = 0; m < layout.materials.size(); ++m)
        text += fmt::format("comment material {} {}\n", m, layout.materials[m]);
    if (layout.meshes)
        for (std::size_t m = 0; m < meshes.size(); ++m)
            text += fmt::format("comment mesh {} {}\n", m, meshes[m].name);
    std::size_t vertices = 0, faces = 0;
    for (const auto& mesh : meshes) {
        vertices += mesh.positions.size();
        faces += mesh.faces.size();
    }
    text += fmt::format("element vertex {}\n", vertices);
    std::set<std::string> taken;
    const auto add_property = [&](std::string name) {
        while (!taken.insert(name).second) name += '_';
        text += fmt::format("property float {}\n", name);
    };
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) add_property(name);
    if (layout.colours)
        for (const char* name : {"red", "green", "blue"}) {
            taken.insert(name);
            text += fmt::format("property uchar {}\n", name);
        }
    for (const auto& attribute : layout.attributes)
        for (const auto& name : component_names(*PlyLayout::attribute_of(meshes.front(), attribute)))
            add_property(name);
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", faces);
    if (layout.uvs) text += "property list uchar float texcoord\n";
    if (!layout.materials.empty()) text += "property int material\n";
    if (layout.meshes) text += "property int mesh\n";
    return text + "end_header\n";
}

void append_vertices(std::vector<std::byte>& bytes, const MeshToExport& mesh, const PlyLayout& layout) {
    std::vector<const take::Attribute*> attributes;
    for (const auto& name : layout.attributes) attributes.push_back(PlyLayout::attribute_of(mesh, name));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(mesh.positions[v][k]));
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(mesh.normals[v][k]));
        if (layout.colours)
            for (std::size_t k = 0; k < 3; ++k)
                append(bytes, static_cast<std::uint8_t>(
                                  std::lround(255 * srgb_from_linear(mesh.colour()->values[3 * v + k]))));
        for (const take::Attribute* attribute : attributes)
            for (int k = 0; k < attribute->components; ++k)
                append(bytes, attribute->values[v * attribute->components + k]);
    }
}

void append_faces(std::vector<std::byte>& bytes, const MeshToExport& mesh, const PlyLayout& layout,
                  std::size_t number, std::size_t first_vertex) {
    std::vector<std::int32_t> materials;  // as the file numbers them
    if (!layout.materials.empty())
        for (const auto& material : mesh.materials)
            materials.push_back(static_cast<std::int32_t>(
                std::find(layout.materials.begin(), layout.materials.end(), material.name) -
                layout.materials.begin()));
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const int corners = geometry::corner_count(mesh.faces[f]);
        append(bytes, static_cast<std::uint8_t>(corners));
        for (int c = 0; c < corners; ++c)
            append(bytes, static_cast<std::int32_t>(first_vertex) + mesh.faces[f][c]);
        if (layout.uvs) {
            append(bytes, static_cast<std::uint8_t>(2 * corners));
            for (int c = 0; c < corners; ++c)
                for (int k = 0; k < 2; ++k) append(bytes, static_cast<float>(mesh.corner_uvs[f][c][k]));
        }
        if (!materials.empty()) append(bytes, materials[mesh.material_of(f)]);
        if (layout.meshes) append(bytes, static_cast<std::int32_t>(number));
    }
}

}  // namespace

std::vector<std::byte> ply_bytes(std::span<const MeshToExport> meshes) {
    const PlyLayout layout(meshes);
    const std::string text = header(meshes, layout);
    const auto head = std::as_bytes(std::span(text));
    std::vector<std::byte> bytes(head.begin(), head.end());
    for (const auto& mesh : meshes) append_vertices(bytes, mesh, layout);
    std::size_t first_vertex = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        append_faces(bytes, meshes[m], layout, m, first_vertex);
        first_vertex += meshes[m].positions.size();
    }
    return bytes;
}

std::vector<std::byte> curves_ply_bytes(std::span<const CurvesToExport> curves) {
    std::size_t points = 0, edges = 0;
    for (const CurvesToExport& hair : curves) {
        points += hair.points.size();
        edges += hair.points.size() - hair.radii.size();
    }
    const std::string text = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment Windfall; metres, Y up\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\nproperty float radius\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n",
        points, edges);
    const auto head = std::as_bytes(std::span(text));
    std::vector<std::byte> bytes(head.begin(), head.end());
    for (const CurvesToExport& hair : curves)
        for (std::size_t point = 0; point < hair.points.size(); ++point) {
            for (int k = 0; k < 3; ++k) append(bytes, hair.points[point][k]);
            append(bytes, hair.radii[hair.strand_of(point)]);
            for (int k = 0; k < 3; ++k)
                append(bytes, static_cast<std::uint8_t>(std::lround(
                                  255 * srgb_from_linear(hair.colours[hair.strand_of(point)][k]))));
        }
    std::int32_t first = 0;
    for (const CurvesToExport& hair : curves) {
        for (const auto& segment : segments_of(hair))
            for (const std::uint32_t end : segment) append(bytes, first + static_cast<std::int32_t>(end));
        first += static_cast<std::int32_t>(hair.points.size());
    }
    return bytes;
}

}  // namespace windfall::export_
