#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "parameter_text.h"
#include "recipe/process.h"
#include "recipe/schema.h"

namespace windfall::cli {

void add_schema(CLI::App& app) {
    struct Options {
        std::string process;
        bool as_json = false;
    };
    CLI::App* command = app.add_subcommand("schema", "List every parameter: unit, range, default, meaning");
    const auto options = std::make_shared<Options>();
    auto* name = command->add_option("PROCESS", options->process,
                                     "Only this process: drying, fracture; all when absent");
    command->add_flag("--json", options->as_json, "All as JSON, for programs")->excludes(name);
    command->footer(
        "Examples:\n"
        "  windfall schema fracture | less\n"
        "  windfall schema --json | jq '.processes.drying.parameters[].key'");
    command->callback([options] {
        if (options->as_json) {
            fmt::print("{}\n", recipe::schema().dump(2));
        } else if (!options->process.empty()) {
            fmt::print("{}", parameter_reference(recipe::process_named(options->process)));
        } else {
            for (const recipe::Process& process : recipe::processes())
                fmt::print("{}{}", &process == recipe::processes().data() ? "" : "\n",
                           parameter_reference(process));
        }
    });
}

}  // namespace windfall::cli
