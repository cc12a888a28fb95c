#pragma once
// Breaks a branch of an artist's tree, from file to file.
#include <filesystem>
#include <vector>

#include "core/run_context.h"
#include "fracture/tree_break.h"
#include "recipe/recipe.h"

namespace windfall::recipe {

struct SnapTreeOptions {
    std::filesystem::path tree;    ///< .obj, .ply, .gltf, .glb
    geometry::Vec3 at;             ///< on the branch's surface or near it, in the file's units and axes
    std::filesystem::path output;  ///< of the same format; what belongs to it is written beside it
    bool overwrite = false;
    bool dry_run = false;  ///< only tells what would be broken
    fracture::TreeBreakOptions break_options;
};

struct SnappedTree {
    fracture::TreeBranch branch;               ///< what was found at the point
    std::vector<std::filesystem::path> files;  ///< that were written; none of a dry run
    std::vector<std::string> warnings;         ///< of the file that was read, and of the recipe
};

/// Whether a file of this name is taken for a tree: it ends in .obj, .ply, .gltf or .glb.
bool is_tree_file(const std::filesystem::path& path);

/// Writes the tree with the stub, and the fallen piece as an object of its own (unless output.piece is
/// "hidden"). Throws InputError for a recipe of another process, for files that cannot be read, exist or are
/// the tree itself, for a folder that cannot be written into, and for what break_tree refuses; RunError when
/// a file cannot be written.
SnappedTree snap_tree(const Recipe& recipe, const SnapTreeOptions& options, const RunContext& context);

}  // namespace windfall::recipe
