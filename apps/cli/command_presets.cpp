#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <variant>

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
    std::string text(std::istreambuf_iterator<char>(stream), {});
    // Files lie beside the preset, and a copy elsewhere must find them.
    const recipe::Recipe loaded = recipe::load(name);
    for (const Parameter<recipe::Recipe>& parameter : recipe::process_named(loaded.process).parameters) {
        if (parameter.info.unit != "file") continue;
        const auto path = std::get<std::string>(parameter.get(loaded));
        if (path.empty()) continue;
        const std::string quoted =
            '"' + std::filesystem::path(path).lexically_relative(file.parent_path()).string() + '"';
        if (const std::size_t at = text.find(quoted); at != std::string::npos)
            text.replace(at, quoted.size(), '"' + path + '"');
    }
    fmt::print("{}", text);
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
