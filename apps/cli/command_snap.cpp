#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "core/error.h"
#include "recipe/snap_tree.h"
#include "run_command.h"
#include "snap_tree_command.h"

namespace windfall::cli {

void add_snap(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "snap",
        "Break a branch or crack a sawn log, into a take folder; or break a branch of a tree of yours");
    struct Options {
        RunOptions run;
        TreeOptions tree;
    };
    const auto options = std::make_shared<Options>();
    add_run_options(*command, options->run, "fracture");
    command->get_option("RECIPE")->description(
        "A preset's name, the path of a recipe file (.toml), or a tree (.glb, .gltf, .obj, .ply)");
    command->get_option("--output")
        ->description(
            "The take's folder, NAME-seedN.take when absent; of a tree the file, NAME-snapped.glb when "
            "absent");
    add_tree_options(*command, options->tree);
    command->footer(
        "Examples:\n"
        "  windfall snap ailanthus\n"
        "  windfall snap cypress --set break.gap=2 --set output.piece=above --seed 7 -o cypress.take\n"
        "  windfall snap log-end --set cracks.check=false\n"
        "  windfall snap fig17 --set branch.rings=40 --set branch.sectors=40 --no-pictures\n"
        "  windfall snap my.toml --dry-run\n"
        "  windfall snap tree.glb --at 0.4,2.1,-0.1 --recipe green-branch -o broken.glb\n"
        "`windfall schema fracture` lists every parameter, `windfall presets` every preset.");
    command->callback([options, command] {
        if (recipe::is_tree_file(options->run.recipe)) return run_snap_tree(options->run, options->tree);
        for (const char* name : {"--at", "--recipe", "--up", "--unit-m", "--falls"})
            if (command->get_option(name)->count() > 0)
                throw InputError(
                    fmt::format("{} needs a tree (.glb, .gltf, .obj, .ply) as the first argument", name));
        run_recipe(options->run, "fracture");
    });
}

}  // namespace windfall::cli
