#include "export/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
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

/// How many of everything stand in the file before a mesh; OBJ counts through all objects.
struct Before {
    std::size_t vertices = 0, uvs = 0, normals = 0;
};

/// The faces in the order of the file: material by material where there are several.
std::vector<std::size_t> face_order(const MeshToExport& mesh) {
    std::vector<std::size_t> order(mesh.faces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return mesh.material_of(a) < mesh.material_of(b); });
    return order;
}

void append_faces(fmt::memory_buffer& text, const MeshToExport& mesh, const TextureCorners& texture,
                  const Before& before, bool with_materials) {
    std::size_t current = mesh.materials.size();  // none yet
    for (const std::size_t f : face_order(mesh)) {
        const std::size_t material = mesh.material_of(f);
        const bool hard = mesh.materials[material].hard;
        if (material != current) {
            if (with_materials)
                fmt::format_to(std::back_inserter(text), "usemtl {}\n", mesh.materials[material].name);
            fmt::format_to(std::back_inserter(text), "s {}\n", hard ? "off" : "1");
            current = material;
        }
        text.push_back('f');
        for (int c = 0; c < geometry::corner_count(mesh.faces[f]); ++c) {
            const auto corner = static_cast<std::size_t>(mesh.faces[f][c]);
            const std::size_t v = before.vertices + corner + 1;
            const std::size_t n = before.normals + (hard ? mesh.normals.size() + f : corner) + 1;
            if (texture.indices.empty())
                fmt::format_to(std::back_inserter(text), " {}//{}", v, n);
            else
                fmt::format_to(std::back_inserter(text), " {}/{}/{}", v, before.uvs + texture.indices[f][c],
                               n);
        }
        text.push_back('\n');
    }
}

void append_curves(fmt::memory_buffer& text, const CurvesToExport& curves, std::size_t vertices_before) {
    fmt::format_to(std::back_inserter(text), "o {}\n", curves.name);
    for (const auto& point : curves.points) append_numbers(text, "v", point.cast<double>());
    for (std::size_t point = 0; point < curves.points.size(); ++point) {
        const auto points_a_strand = static_cast<std::size_t>(curves.points_per_strand);
        fmt::format_to(std::back_inserter(text), "{} {}{}", point % points_a_strand == 0 ? "l" : "",
                       vertices_before + point + 1, (point + 1) % points_a_strand == 0 ? "\n" : "");
    }
}

}  // namespace

std::string obj_text(std::span<const MeshToExport> meshes, const std::string& material_file,
                     std::span<const CurvesToExport> curves) {
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "# Windfall; metres, Y up\n");
    if (!material_file.empty()) fmt::format_to(std::back_inserter(text), "mtllib {}\n", material_file);
    Before before;
    for (const MeshToExport& mesh : meshes) {
        const TextureCorners texture = texture_corners(mesh);
        fmt::format_to(std::back_inserter(text), "o {}\n", mesh.name);
        for (const Vec3& p : mesh.positions) append_numbers(text, "v", p);
        for (const Vec2& uv : texture.uvs)
            fmt::format_to(std::back_inserter(text), "vt {} {}\n", static_cast<float>(uv.x()),
                           static_cast<float>(uv.y()));
        for (const Vec3& n : mesh.normals) append_numbers(text, "vn", n);
        for (const Vec3& n : mesh.face_normals) append_numbers(text, "vn", n);
        append_faces(text, mesh, texture, before, !material_file.empty());
        before.vertices += mesh.positions.size();
        before.uvs += texture.uvs.size();
        before.normals += mesh.normals.size() + mesh.face_normals.size();
    }
    for (const CurvesToExport& hair : curves) {
        append_curves(text, hair, before.vertices);
        before.vertices += hair.points.size();
    }
    return fmt::to_string(text);
}

std::string mtl_text(std::span<const MeshToExport> meshes) {
    std::string text = "# Windfall\n";
    std::set<std::string> written;
    for (const MeshToExport& mesh : meshes) {
        const auto used = mesh.used_materials();
        for (std::size_t m = 0; m < used.size(); ++m) {
            const ExportMaterial& material = mesh.materials[m];
            if (!used[m] || !written.insert(material.name).second) continue;
            const auto& c = material.base_colour;
            text += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nKs 0 0 0\nPr {:.4g}\nillum 1\n",
                                material.name, c[0], c[1], c[2], material.roughness);
        }
    }
    return text;
}

}  // namespace windfall::export_
