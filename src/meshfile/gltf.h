#pragma once
// glTF 2.0, as text or in one binary file.
#include <filesystem>
#include <span>
#include <string>

#include "meshfile/mesh.h"
#include "meshfile/mesh_file.h"

namespace windfall::meshfile {

/// Reads the triangles of all nodes of the scene; each primitive of each node is a group with vertices of its
/// own. `folder` is where buffers that are files of their own lie.
Mesh read_gltf(std::span<const std::byte> bytes, const std::string& name, Format format,
               const std::filesystem::path& folder);

/// One file; a .gltf has its buffer in it. Vertex data are written as 32-bit floats.
std::vector<OutputFile> encode_gltf(std::span<const NamedMesh> meshes, const std::filesystem::path& path,
                                    Format format);

}  // namespace windfall::meshfile
