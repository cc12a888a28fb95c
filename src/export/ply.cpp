#include "export/ply.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <set>
#include <span>
#include <string>

namespace windfall::export_ {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <class T>
void append(std::vector<std::byte>& bytes, T number) {
    const auto raw = std::as_bytes(std::span(&number, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

std::string header(const MeshToExport& mesh) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment Windfall; metres, Y up\n";
    text += fmt::format("element vertex {}\n", mesh.positions.size());
    std::set<std::string> taken;
    const auto add_property = [&](std::string name) {
        while (!taken.insert(name).second) name += '_';
        text += fmt::format("property float {}\n", name);
    };
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) add_property(name);
    for (const auto& attribute : mesh.attributes)
        for (const auto& name : component_names(attribute)) add_property(name);
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.faces.size());
    if (!mesh.corner_uvs.empty()) text += "property list uchar float texcoord\n";
    return text + "end_header\n";
}

}  // namespace

std::vector<std::byte> ply_bytes(const MeshToExport& mesh) {
    const std::string text = header(mesh);
    const auto head = std::as_bytes(std::span(text));
    std::vector<std::byte> bytes(head.begin(), head.end());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(mesh.positions[v][k]));
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(mesh.normals[v][k]));
        for (const auto& attribute : mesh.attributes)
            for (int k = 0; k < attribute.components; ++k)
                append(bytes, attribute.values[v * attribute.components + k]);
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const int corners = geometry::corner_count(mesh.faces[f]);
        append(bytes, static_cast<std::uint8_t>(corners));
        for (int c = 0; c < corners; ++c) append(bytes, mesh.faces[f][c]);
        if (mesh.corner_uvs.empty()) continue;
        append(bytes, static_cast<std::uint8_t>(2 * corners));
        for (int c = 0; c < corners; ++c)
            for (int k = 0; k < 2; ++k) append(bytes, static_cast<float>(mesh.corner_uvs[f][c][k]));
    }
    return bytes;
}

}  // namespace windfall::export_
