#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "parameter_text.h"
#include "recipe/schema.h"

namespace windfall::cli {

void add_schema(CLI::App& app) {
    CLI::App* command = app.add_subcommand("schema", "List every parameter: unit, range, default, meaning");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "As JSON, for programs");
    command->footer(
        "Examples:\n"
        "  windfall schema | less\n"
        "  windfall schema --json | jq '.processes.drying.parameters[].key'");
    command->callback([json] {
        if (*json)
            fmt::print("{}\n", recipe::schema().dump(2));
        else
            fmt::print("{}", parameter_reference());
    });
}

}  // namespace windfall::cli
