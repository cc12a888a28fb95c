#include "export/obj.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <utility>

namespace windfall::export_ {
namespace {

using geometry::Vec2;
using geometry::Vec3;

// The shortest text that reads back as the same 32-bit number, which is what a take holds.
void append_numbers(fmt::memory_buffer& text, const char* tag, const Vec3& v) {
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", tag, static_cast<float>(v.x()),
                   static_cast<float>(v.y()), static_cast<float>(v.z()));
}

// Texture coordinates, each pair once, and the index (from 1) of every corner's pair.
struct TextureCorners {
    std::vector<Vec2> uvs;
    std::vector<std::array<std::size_t, 4>> indices;
};

TextureCorners texture_corners(const MeshToExport& mesh) {
    TextureCorners corners;
    std::map<std::pair<double, double>, std::size_t> index_of;
    for (std::size_t f = 0; f < mesh.corner_uvs.size(); ++f) {
        corners.indices.emplace_back();
        for (int c = 0; c < geometry::corner_count(mesh.faces[f]); ++c) {
            const Vec2& uv = mesh.corner_uvs[f][c];
            const auto [found, is_new] = index_of.try_emplace({uv.x(), uv.y()}, corners.uvs.size() + 1);
            if (is_new) corners.uvs.push_back(uv);
            corners.indices.back()[c] = found->second;
        }
    }
    return corners;
}

}  // namespace

std::string obj_text(const MeshToExport& mesh) {
    const TextureCorners texture = texture_corners(mesh);
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "# Windfall; metres, Y up\no {}\n", mesh.name);
    for (const Vec3& p : mesh.positions) append_numbers(text, "v", p);
    for (const Vec2& uv : texture.uvs)
        fmt::format_to(std::back_inserter(text), "vt {} {}\n", static_cast<float>(uv.x()),
                       static_cast<float>(uv.y()));
    for (const Vec3& n : mesh.normals) append_numbers(text, "vn", n);
    fmt::format_to(std::back_inserter(text), "s 1\n");
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        text.push_back('f');
        for (int c = 0; c < geometry::corner_count(mesh.faces[f]); ++c) {
            const std::int32_t v = mesh.faces[f][c] + 1;
            if (texture.indices.empty())
                fmt::format_to(std::back_inserter(text), " {}//{}", v, v);
            else
                fmt::format_to(std::back_inserter(text), " {}/{}/{}", v, texture.indices[f][c], v);
        }
        text.push_back('\n');
    }
    return fmt::to_string(text);
}

}  // namespace windfall::export_
