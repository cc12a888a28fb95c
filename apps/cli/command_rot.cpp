#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "core/error.h"
#include "run_command.h"

namespace windfall::cli {
namespace {

/// "x,y,z" three numbers, appended to a list.
void append_point(const std::string& text, std::string& list) {
    std::size_t commas = 0;
    for (const char c : text) commas += c == ',' ? 1U : 0U;
    if (commas != 2)
        throw InputError(fmt::format(
            "--wound takes three numbers with commas between, x,y,z in metres, not \"{}\"", text));
    list += (list.empty() ? "" : ", ") + text;
}

}  // namespace

void add_rot(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "rot", "Rot a fruit: mold and soft rot grow, water leaves, flesh sinks, skin wrinkles");
    struct Options {
        RunOptions run;
        std::vector<std::string> wounds;
    };
    const auto options = std::make_shared<Options>();
    add_run_options(*command, options->run, "decay");
    command
        ->add_option(
            "--wound", options->wounds,
            "Where rot begins: x,y,z in metres on the fresh fruit, which stands on y = 0 about the y axis; "
            "may be given several times")
        ->allow_extra_args(false);
    command->footer(
        "Examples:\n"
        "  windfall rot orange\n"
        "  windfall rot tomato --set climate.name=tropical --seed 7 -o tomato.take\n"
        "  windfall rot apple --wound 0.02,0.05,0.025 --set start.random=0 --set output.frames=200\n"
        "  windfall rot pile-of-oranges\n"
        "  windfall rot my.toml --dry-run\n"
        "`windfall schema decay` lists every parameter, `windfall presets` every preset.");
    command->callback([options] {
        std::string wounds;
        for (const std::string& wound : options->wounds) append_point(wound, wounds);
        if (!wounds.empty()) options->run.settings.push_back("start.wounds_m=[" + wounds + "]");
        run_recipe(options->run, "decay");
    });
}

}  // namespace windfall::cli
