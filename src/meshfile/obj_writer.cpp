#include <fmt/format.h>

#include <iterator>
#include <set>

#include "meshfile/obj.h"
#include "meshfile/text_scanner.h"
#include "meshfile/texture_path.h"

namespace windfall::meshfile {
namespace {

using Text = fmt::memory_buffer;

template <class... T>
void put(Text& text, fmt::format_string<T...> format, T&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<T>(arguments)...);
}

/// Numbers of what earlier meshes of the file have: OBJ counts on.
struct Offsets {
    std::size_t vertex = 1, texture = 1, normal = 1;
};

const Attribute* find(const Mesh& mesh, std::string_view name) {
    for (const Attribute& a : mesh.attributes)
        if (a.name == name) return &a;
    return nullptr;
}

void put_vertices(Text& text, const NamedMesh& named) {
    const Mesh& mesh = *named.mesh;
    const Attribute* colour = find(mesh, "colour");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        // The shortest text that reads back as the same number.
        const Vec3 p = mesh.positions[v] + named.shift;
        if (named.shift.isZero())
            put(text, "v {} {} {}", p.x(), p.y(), p.z());
        else
            put(text, "v {} {} {}", static_cast<float>(p.x()), static_cast<float>(p.y()),
                static_cast<float>(p.z()));
        if (colour != nullptr && colour->values[3 * v] == colour->values[3 * v])
            put(text, " {} {} {}", colour->values[3 * v], colour->values[3 * v + 1],
                colour->values[3 * v + 2]);
        text.push_back('\n');
    }
    if (const Attribute* vt = find(mesh, "vt"))
        for (std::size_t i = 0; i < vt->values.size(); i += 2)
            put(text, "vt {} {}\n", vt->values[i], vt->values[i + 1]);
    if (const Attribute* vn = find(mesh, "vn"))
        for (std::size_t i = 0; i < vn->values.size(); i += 3)
            put(text, "vn {} {} {}\n", vn->values[i], vn->values[i + 1], vn->values[i + 2]);
}

void put_corner(Text& text, const Mesh& mesh, std::size_t c, const Attribute* vt, const Attribute* vn,
                const Offsets& from) {
    put(text, " {}", from.vertex + static_cast<std::size_t>(mesh.corners[c]));
    const std::int32_t texture = vt != nullptr ? vt->corner_entries[c] : -1;
    const std::int32_t normal = vn != nullptr ? vn->corner_entries[c] : -1;
    if (texture >= 0) put(text, "/{}", from.texture + static_cast<std::size_t>(texture));
    if (normal >= 0)
        put(text, "{}{}", texture >= 0 ? "/" : "//", from.normal + static_cast<std::size_t>(normal));
}

void put_faces(Text& text, const NamedMesh& named, bool is_first, const Offsets& from) {
    const Mesh& mesh = *named.mesh;
    const Attribute* vt = find(mesh, "vt");
    const Attribute* vn = find(mesh, "vn");
    FaceInfo last{-1, -1, 0};
    std::string object, group;
    put(text, "s off\n");
    if (!is_first) put(text, "o {}\n", named.name);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const FaceInfo& info = mesh.faces[f];
        if (info.group != last.group) {
            const Group& now = mesh.groups[static_cast<std::size_t>(info.group)];
            if (is_first && now.object != object) put(text, "o {}\n", object = now.object);
            if (now.name != group) put(text, "g {}\n", group = now.name);
        }
        if (info.material != last.material && info.material >= 0)
            put(text, "usemtl {}\n", mesh.materials[static_cast<std::size_t>(info.material)].name);
        if (info.smoothing != last.smoothing) {
            if (info.smoothing == 0)
                put(text, "s off\n");
            else
                put(text, "s {}\n", info.smoothing);
        }
        last = info;
        text.push_back('f');
        for (std::size_t c = mesh.face_starts[f]; c < mesh.face_starts[f + 1]; ++c)
            put_corner(text, mesh, c, vt, vn, from);
        text.push_back('\n');
    }
}

void count_on(Offsets& from, const Mesh& mesh) {
    from.vertex += mesh.positions.size();
    if (const Attribute* vt = find(mesh, "vt")) from.texture += vt->values.size() / 2;
    if (const Attribute* vn = find(mesh, "vn")) from.normal += vn->values.size() / 3;
}

/// The statements that end in the name of a texture's file.
bool names_texture(std::string_view word) {
    return word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
           word == "refl" || word == "norm";
}

/// The materials as they came, with textures pointed to from the new folder, and the new ones.
std::string material_text(const Mesh& mesh, const std::filesystem::path& folder) {
    const auto* source = dynamic_cast<const ObjSource*>(mesh.source.get());
    Text text;
    if (source != nullptr) {
        TextScanner scan(source->material_text, "mtl");
        while (scan.next_line()) {
            const std::string line(scan.rest());
            const bool has_texture = names_texture(scan.word());
            std::string name(scan.rest());
            // Names may have blanks in them, but behind options only the last word is the name.
            if (name.starts_with('-')) name = name.substr(name.find_last_of(" \t") + 1);
            if (has_texture && !name.empty())
                put(text, "{}{}\n", line.substr(0, line.size() - name.size()),
                    moved_texture(name, source->folder, folder));
            else
                put(text, "{}\n", line);
        }
    }
    for (const Material& material : mesh.materials) {
        if (material.source >= 0) continue;
        const auto& c = material.base_colour;
        // MTL's shininess: the exponent of a Blinn highlight as wide as that of GGX.
        const float alpha = material.roughness * material.roughness;
        put(text, "\nnewmtl {}\nKd {} {} {}\nKs 0.04 0.04 0.04\nNs {:.3g}\nillum 2\n", material.name, c[0],
            c[1], c[2], std::max(1.0F, 2 / (alpha * alpha) - 2));
    }
    return fmt::to_string(text);
}

std::vector<std::byte> bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<OutputFile> encode_obj(std::span<const NamedMesh> meshes, const std::filesystem::path& path) {
    const std::filesystem::path material_path = std::filesystem::path(path).replace_extension(".mtl");
    const std::string materials = material_text(*meshes[0].mesh, path.parent_path());
    Text text;
    put(text, "# Windfall\n");
    if (!materials.empty()) put(text, "mtllib {}\n", material_path.filename().string());
    if (const auto* source = dynamic_cast<const ObjSource*>(meshes[0].mesh->source.get()))
        for (const std::string& library : source->other_libraries)
            put(text, "mtllib {}\n", moved_texture(library, source->folder, path.parent_path()));
    Offsets from;
    for (const NamedMesh& named : meshes) {
        put_vertices(text, named);
        put_faces(text, named, &named == meshes.data(), from);
        count_on(from, *named.mesh);
    }
    std::vector<OutputFile> files{{path, bytes_of({text.data(), text.size()})}};
    if (!materials.empty()) files.push_back({material_path, bytes_of(materials)});
    return files;
}

}  // namespace windfall::meshfile
