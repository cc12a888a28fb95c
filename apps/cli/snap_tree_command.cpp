#include "snap_tree_command.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>

#include "cancel.h"
#include "core/parallel.h"
#include "progress.h"
#include "recipe/snap_tree.h"

namespace windfall::cli {
namespace {

namespace fs = std::filesystem;

geometry::Vec3 point_of(const std::string& text) {
    geometry::Vec3 point;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int i = 0; i < 3; ++i) {
        const auto [behind, error] = std::from_chars(at, end, point[i]);
        const bool last = i == 2;
        if (error != std::errc() || !std::isfinite(point[i]) ||
            (last ? behind != end : behind == end || *behind != ','))
            throw InputError(
                fmt::format("--at {}: must be three numbers x,y,z without blanks, in the units and axes of "
                            "the tree's file",
                            text));
        at = behind + 1;
    }
    return point;
}

/// Options that a tree has no use for.
void refuse_take_options(const RunOptions& options) {
    const auto refuse = [](bool given, const char* name) {
        if (given)
            throw InputError(
                fmt::format("{} is for takes; a tree is broken at once, without pictures", name));
    };
    refuse(options.resume, "--resume");
    refuse(options.no_pictures, "--no-pictures");
}

void snap(const RunOptions& options, const TreeOptions& tree, ProgressPrinter& printer) {
    if (tree.at.empty())
        throw InputError(fmt::format(
            "{} is a tree: tell where to break it with --at x,y,z, a point on the branch's surface",
            options.recipe));
    refuse_take_options(options);
    if (!(tree.unit_m > 0) || !std::isfinite(tree.unit_m))
        throw InputError("--unit-m must be larger than 0: the metres of a unit of the tree's file");
    recipe::SnapTreeOptions settings;
    settings.tree = options.recipe;
    settings.at = point_of(tree.at);
    settings.output =
        options.output.empty()
            ? fs::path(settings.tree.stem().string() + "-snapped" + settings.tree.extension().string())
            : fs::path(options.output);
    settings.overwrite = options.force;
    settings.dry_run = options.dry_run;
    settings.break_options.unit_m = tree.unit_m;
    if (tree.up == "z") settings.break_options.up = geometry::Vec3::UnitZ();
    if (tree.falls == "smaller") settings.break_options.falls = fracture::FallingSide::Smaller;
    if (tree.falls == "larger") settings.break_options.falls = fracture::FallingSide::Larger;

    RunContext context;
    context.cancel = &cancel_on_signals();
    context.on_progress = [&](const Progress& progress) { printer.progress(progress); };
    const recipe::SnappedTree result =
        recipe::snap_tree(recipe::load(tree.recipe, options.all_settings()), settings, context);
    for (const std::string& warning : result.warnings) printer.warning(warning);
    if (!options.dry_run) return printer.written(result.files);
    const auto text = [](const geometry::Vec3& v) {
        return fmt::format("{:.5g},{:.5g},{:.5g}", v.x(), v.y(), v.z());
    };
    fmt::print("branch       at {}, {:.4g} thick, along {}\n", text(result.branch.centre),
               2 * result.branch.radius, text(result.branch.axis));
    fmt::print("output       {}\n", settings.output.string());
}

}  // namespace

void add_tree_options(CLI::App& command, TreeOptions& tree) {
    const std::string group = "For a tree";
    command
        .add_option("--at", tree.at, "Where to break it: a point on the branch, in the file's units and axes")
        ->type_name("X,Y,Z")
        ->group(group);
    command.add_option("--recipe", tree.recipe, "How it breaks: a preset's name or a recipe's path")
        ->capture_default_str()
        ->group(group);
    command.add_option("--up", tree.up, "The axis that points up in the file")
        ->check(CLI::IsMember({"y", "z"}))
        ->capture_default_str()
        ->group(group);
    command.add_option("--unit-m", tree.unit_m, "Metres of one unit of the file: 0.01 for centimetres")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--falls", tree.falls,
                    "Which part falls: the one away from the root, the smaller or the larger")
        ->check(CLI::IsMember({"away", "smaller", "larger"}))
        ->capture_default_str()
        ->group(group);
}

void run_snap_tree(const RunOptions& options, const TreeOptions& tree) {
    const ThreadLimit threads(options.threads);
    run_and_report(options.progress, [&](ProgressPrinter& printer) { snap(options, tree, printer); });
}

}  // namespace windfall::cli
