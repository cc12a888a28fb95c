#pragma once
// Wavefront OBJ: polygons, texture coordinates and normals at corners, materials by name.
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "meshfile/mesh.h"
#include "meshfile/mesh_file.h"

namespace windfall::meshfile {

/// What the files of materials say, as it is.
struct ObjSource final : Source {
    ObjSource() : Source(Format::Obj) {}
    std::filesystem::path folder;  ///< that the textures are relative to
    std::string material_text;
    std::vector<std::string> other_libraries;  ///< names of materials' files elsewhere, which are not read
};

/// The text of a file beside the OBJ; empty when there is none.
using TextOf = std::function<std::string(const std::string& file_name)>;

/// `name` is for messages.
Mesh read_obj(std::string_view text, const std::string& name, const std::filesystem::path& folder,
              const TextOf& text_of);

/// The OBJ file and, when there are materials, their file NAME.mtl.
std::vector<OutputFile> encode_obj(std::span<const NamedMesh> meshes, const std::filesystem::path& path);

}  // namespace windfall::meshfile
