#include "meshfile/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "core/error.h"
#include "meshfile/gltf.h"
#include "meshfile/obj.h"
#include "meshfile/ply.h"

namespace windfall::meshfile {
namespace {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& path) {
    std::error_code failed;
    if (fs::is_directory(path, failed))
        throw InputError(fmt::format("{} is a folder; give the path of a file", path.string()));
    if (!fs::is_regular_file(path, failed))
        throw InputError(fmt::format("{}: there is no such file; check the name", path.string()));
    const std::uintmax_t size = fs::file_size(path, failed);
    if (size > kMaxFileBytes)
        throw InputError(fmt::format("{}: {:.1f} GiB are more than can be read ({:.0f}); decimate the mesh",
                                     path.string(), static_cast<double>(size) / (1U << 30U),
                                     static_cast<double>(kMaxFileBytes) / (1U << 30U)));
    if (size == 0) throw InputError(fmt::format("{}: the file is empty; export it again", path.string()));
    std::string bytes(size, '\0');
    std::ifstream file(path, std::ios::binary);
    if (failed || !file.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw InputError(fmt::format("{}: the file cannot be read; check its permissions", path.string()));
    return bytes;
}

}  // namespace

Format format_of(const fs::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (ending == ".obj") return Format::Obj;
    if (ending == ".ply") return Format::Ply;
    if (ending == ".gltf") return Format::Gltf;
    if (ending == ".glb") return Format::Glb;
    throw InputError(fmt::format(
        "{}: a tree is read from .obj, .ply, .gltf or .glb; export it as one of them", path.string()));
}

Mesh read(const fs::path& path) {
    const Format format = format_of(path);
    const std::string text = read_bytes(path);
    const std::string name = path.string();
    const fs::path folder = path.parent_path();
    Mesh mesh;
    if (format == Format::Obj) {
        mesh = read_obj(text, name, folder, [&](const std::string& file) {
            std::error_code failed;
            return fs::is_regular_file(folder / file, failed) ? read_bytes(folder / file) : std::string();
        });
    } else if (format == Format::Ply) {
        mesh = read_ply(text, name);
    } else {
        mesh = read_gltf(std::as_bytes(std::span(text)), name, format, folder);
    }
    check(mesh, name);
    return mesh;
}

std::vector<fs::path> output_paths(Format format, const fs::path& path, std::span<const std::string> names) {
    std::vector<fs::path> paths{path};
    for (std::size_t m = 1; m < names.size() && format == Format::Ply; ++m)
        paths.push_back(path.parent_path() /
                        fmt::format("{}_{}{}", path.stem().string(), names[m], path.extension().string()));
    if (format == Format::Obj) paths.push_back(fs::path(path).replace_extension(".mtl"));
    return paths;
}

std::vector<OutputFile> encode(std::span<const NamedMesh> meshes, const fs::path& path) {
    const Format format = format_of(path);
    const auto is_gltf = [](Format f) { return f == Format::Gltf || f == Format::Glb; };
    const Source* source = meshes[0].mesh->source.get();
    if (source != nullptr && source->format != format && !(is_gltf(source->format) && is_gltf(format)))
        throw InputError(
            fmt::format("{}: a tree is written in the format that it came in; give the output that ending",
                        path.string()));
    if (format == Format::Obj) return encode_obj(meshes, path);
    if (format == Format::Ply) return encode_ply(meshes, path);
    return encode_gltf(meshes, path, format);
}

}  // namespace windfall::meshfile
