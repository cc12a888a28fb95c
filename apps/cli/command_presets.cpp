#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "commands.h"
#include "core/error.h"
#include "recipe/presets.h"
#include "recipe/process.h"
#include "recipe/recipe.h"

namespace windfall::cli {
namespace {

void list_presets() {
    std::vector<recipe::Recipe> presets;
    for (const std::string& name : recipe::preset_names()) presets.push_back(recipe::load(name));
    for (const recipe::Process& process : recipe::processes()) {
        fmt::print("{}{} (`windfall {} NAME`: {})\n\n", &process == recipe::processes().data() ? "" : "\n",
                   process.name, process.command, process.doc);
        for (const recipe::Recipe& preset : presets)
            if (preset.process == process.name)
                fmt::print("{:<14} {}\n{:<14} {}\n", preset.name, preset.title, "", preset.description);
    }
}

void print_file(const std::string& name) {
    const std::filesystem::path file = recipe::preset_file(name);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError("cannot read the preset " + file.string());
    fmt::print("{}", std::string(std::istreambuf_iterator<char>(stream), {}));
}

}  // namespace

void add_presets(CLI::App& app) {
    struct Options {
        std::string name;
        bool resolved = false;
    };
    CLI::App* command = app.add_subcommand("presets", "List the shipped recipes, or print one of them");
    const auto options = std::make_shared<Options>();
    command->add_option("NAME", options->name, "Print this preset's file");
    command->add_flag("--resolved", options->resolved,
                      "Print every key with its value, also those left at the default");
    command->footer(
        "Examples:\n"
        "  windfall presets\n"
        "  windfall presets jujube > my.toml       a recipe of your own to begin from\n"
        "  windfall presets jujube --resolved      with every key");
    command->callback([options] {
        if (options->name.empty()) {
            if (options->resolved) throw InputError("--resolved needs the name of a preset");
            return list_presets();
        }
        if (!options->resolved) return print_file(options->name);
        recipe::preset_file(options->name);  // a preset's name, not a file's
        fmt::print("{}", recipe::to_toml(recipe::load(options->name)));
    });
}

}  // namespace windfall::cli
