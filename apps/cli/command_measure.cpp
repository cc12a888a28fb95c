#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "recipe/process.h"

namespace windfall::cli {
namespace {

using nlohmann::json;

std::string cell(const json& value, int digits) {
    return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), digits) : "-";
}

/// A number as it is, whole numbers without a point.
std::string plain(const json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.dump();
}

/// Those that some frame has a number for: hours are for what dries by the hour.
std::vector<recipe::MeasureColumn> columns_with_numbers(const json& frames,
                                                        std::vector<recipe::MeasureColumn> columns) {
    std::erase_if(columns, [&](const recipe::MeasureColumn& column) {
        return std::none_of(frames.begin(), frames.end(),
                            [&](const json& frame) { return frame.contains(column.key); });
    });
    return columns;
}

void print_table(const json& measures, const std::vector<recipe::MeasureColumn>& all_columns) {
    const json frames = measures.value("frames", json::array());
    const std::vector<recipe::MeasureColumn> columns = columns_with_numbers(frames, all_columns);
    for (const auto& column : columns) fmt::print("{:>{}}", column.title, column.title.size() + 2);
    fmt::print("\n");
    for (const json& frame : frames) {
        for (const auto& column : columns)
            fmt::print("{:>{}}", cell(frame.value(column.key, json()), column.digits),
                       column.title.size() + 2);
        fmt::print("\n");
    }
    fmt::print("\n");
    for (const auto& [key, value] : measures.items())
        if (value.is_primitive()) fmt::print("{:<22} {}\n", key, plain(value));
}

}  // namespace

void add_measure(CLI::App& app) {
    struct Options {
        std::string take;
        bool as_json = false;
    };
    CLI::App* command =
        app.add_subcommand("measure", "Measure a take: wave lengths of wrinkles, height of a break, volumes");
    const auto options = std::make_shared<Options>();
    command->add_option("TAKE", options->take, "The take's folder")->required();
    command->add_flag("--json", options->as_json, "Everything, for programs");
    command->footer(
        "Examples:\n"
        "  windfall measure jujube-seed1.take\n"
        "  windfall measure jujube-seed1.take --json | jq '.frames[-1].valleys'\n"
        "  windfall measure cypress-seed5.take\n"
        "docs/measures.md defines every number.");
    command->callback([options] {
        const take::TakeReader take(options->take);
        const recipe::Process& process = recipe::process_named(take.info().process);
        const json measures = process.measure(take);
        if (options->as_json)
            fmt::print("{}\n", measures.dump(2));
        else
            print_table(measures, process.measure_columns);
    });
}

}  // namespace windfall::cli
