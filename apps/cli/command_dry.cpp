#include <memory>

#include "commands.h"
#include "run_command.h"

namespace windfall::cli {

void add_dry(CLI::App& app) {
    CLI::App* command = app.add_subcommand("dry", "Dry a fruit until its skin wrinkles, into a take folder");
    const auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options, "drying");
    command->footer(
        "Examples:\n"
        "  windfall dry jujube\n"
        "  windfall dry sphere --set material.gamma=20 --seed 7 -o stiff.take\n"
        "  windfall dry my.toml --dry-run\n"
        "  windfall dry plum --set output.shrinkages=[0.1,0.2,0.3] --no-pictures\n"
        "  windfall dry jujube-seed1.take/recipe.toml -o jujube-seed1.take --resume\n"
        "`windfall schema drying` lists every parameter, `windfall presets` every preset.");
    command->callback([options] { run_recipe(*options, "drying"); });
}

}  // namespace windfall::cli
