#pragma once
// What the reader and the writer of glTF share.
#include <tiny_gltf.h>

#include <filesystem>
#include <vector>

#include "meshfile/mesh.h"

namespace windfall::meshfile {

struct GltfSource final : Source {
    explicit GltfSource(Format its_format) : Source(its_format) {}
    tinygltf::Model model;
    std::filesystem::path folder;  ///< that names of files are relative to
};

/// The numbers of an accessor, normalized integers as fractions, one element after another. Throws
/// std::out_of_range with a text when the accessor reaches beyond its data.
std::vector<double> accessor_values(const tinygltf::Model& model, int index);

/// The numbers of vertices in an accessor, each below `count`. Throws std::out_of_range also when they are
/// fractions, may have signs or point elsewhere.
std::vector<std::uint32_t> accessor_indices(const tinygltf::Model& model, int index, std::size_t count);

/// The bytes of an accessor's elements without gaps, in its own type, with what is sparse filled in.
std::vector<unsigned char> accessor_bytes(const tinygltf::Model& model, int index);

/// The bytes of a view.
std::vector<unsigned char> view_bytes(const tinygltf::Model& model, int index);

int component_count(const tinygltf::Accessor& accessor);

}  // namespace windfall::meshfile
