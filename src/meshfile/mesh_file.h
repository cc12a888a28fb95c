#pragma once
// Meshes that artists make elsewhere: read, and written again in the format they came in.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meshfile/mesh.h"

namespace windfall::meshfile {

/// The largest file that is read.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30U;
/// The largest number of corners of faces (and of vertices) that a mesh may have.
inline constexpr std::size_t kMaxCorners = 50'000'000;

/// .obj, .ply, .gltf or .glb. Throws InputError for any other ending.
Format format_of(const std::filesystem::path& path);

/// Reads a mesh with all that is needed to write it again. Lengths and axes stay those of the file.
/// Throws InputError (file, line where there is one, remedy) for what cannot be read, for an empty or huge
/// mesh and for positions that are not finite.
Mesh read(const std::filesystem::path& path);

/// A mesh of a file, moved by `shift` (in the world of the file).
struct NamedMesh {
    std::string name;
    const Mesh* mesh;
    Vec3 shift = Vec3::Zero();
};

struct OutputFile {
    std::filesystem::path path;
    std::vector<std::byte> bytes;
};

/// The names of the files that `encode` makes for `path`: the mesh itself, then what belongs to it. PLY has
/// one file a mesh, OBJ a second one for its materials.
std::vector<std::filesystem::path> output_paths(Format format, const std::filesystem::path& path,
                                                std::span<const std::string> names);

/// All that is to be written for `path`, in the format of the first mesh's source; nothing touches the disk.
/// The first mesh stays what and where it was in the file; the others become objects (nodes) of their own.
/// Textures that are files of their own are pointed to where they lie. InputError when `path` has the ending
/// of another format.
std::vector<OutputFile> encode(std::span<const NamedMesh> meshes, const std::filesystem::path& path);

}  // namespace windfall::meshfile
