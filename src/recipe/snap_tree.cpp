#include "recipe/snap_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "fracture/plan.h"
#include "meshfile/mesh_file.h"
#include "take/whole_file.h"

namespace windfall::recipe {
namespace {

namespace fs = std::filesystem;

std::string lower_case_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension;
}

/// Before the work is done, so that nobody waits for nothing.
void check_output(const SnapTreeOptions& options, const std::vector<std::string>& names) {
    if (lower_case_extension(options.output) != lower_case_extension(options.tree))
        throw InputError(
            fmt::format("{}: the broken tree is written as it was read; choose a name that ends "
                        "in {} with -o",
                        options.output.string(), options.tree.extension().string()));
    std::error_code ignored;
    for (const fs::path& path :
         meshfile::output_paths(meshfile::format_of(options.tree), options.output, names)) {
        if (fs::equivalent(path, options.tree, ignored))
            throw InputError(
                fmt::format("{} is the tree itself, which is never replaced; choose another name with -o",
                            path.string()));
        if (fs::is_directory(path, ignored))
            throw InputError(fmt::format("{} is a folder; choose another name with -o", path.string()));
        if (!options.overwrite && fs::exists(path, ignored))
            throw InputError(
                fmt::format("{} is there already; add --force to replace it, or choose another name with -o",
                            path.string()));
    }
}

/// Whether files can be put into the folder, or, where it is still to be made, into the one above it.
void check_folder(const fs::path& output) {
    std::error_code ignored;
    fs::path folder = fs::absolute(output).parent_path();
    while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
    take::make_writable_folder(folder);
}

void write(const std::vector<meshfile::NamedMesh>& meshes, const fs::path& output,
           std::vector<fs::path>& written) {
    const std::vector<meshfile::OutputFile> files = meshfile::encode(meshes, output);
    if (const fs::path folder = output.parent_path(); !folder.empty()) take::make_writable_folder(folder);
    for (const meshfile::OutputFile& file : files) {
        take::write_whole_file(file.path, file.bytes);
        written.push_back(file.path);
    }
}

}  // namespace

bool is_tree_file(const fs::path& path) {
    const std::string extension = lower_case_extension(path);
    return extension == ".obj" || extension == ".ply" || extension == ".gltf" || extension == ".glb";
}

SnappedTree snap_tree(const Recipe& recipe, const SnapTreeOptions& options, const RunContext& context) {
    if (recipe.process != "fracture")
        throw InputError(fmt::format(
            "{} is a recipe of the process \"{}\", which breaks no tree; `windfall presets` lists others",
            recipe.name, recipe.process));
    const bool with_piece = recipe.fracture.output.piece != fracture::PiecePlace::Hidden;
    std::vector<std::string> names{"tree"};
    if (with_piece) names.emplace_back("fallen_piece");
    check_output(options, names);
    check_folder(options.output);

    fracture::FractureParameters of_tree = recipe.fracture;
    of_tree.branch.taper = of_tree.branch.bend_deg = 0;  // the tree has its own
    const std::vector<std::string> warnings = fracture::plan(of_tree).warnings;

    context.progress({"reading the tree", 0, 1, -1, ""});
    const meshfile::Mesh mesh = meshfile::read(options.tree);
    context.throw_if_cancelled();
    const fracture::TreeBreak broken =
        fracture::break_tree(mesh, options.at, recipe.fracture, options.break_options, context);
    SnappedTree result{broken.branch, {}, mesh.warnings};
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    if (options.dry_run) return result;

    context.throw_if_cancelled();
    std::vector<meshfile::NamedMesh> meshes{{names[0], &broken.tree}};
    if (with_piece) meshes.push_back({names[1], &broken.piece, broken.piece_shift});
    write(meshes, options.output, result.files);
    context.progress({"reading the tree", 1, 1, 0, ""});
    return result;
}

}  // namespace windfall::recipe
