#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "drying/measure.h"

namespace windfall::cli {
namespace {

using nlohmann::json;

struct Column {
    const char* key;
    const char* title;
    int digits;
};

constexpr Column kColumns[] = {
    {"frame", "frame", 0},
    {"time", "time", 3},
    {"shrinkage", "shrinkage", 4},
    {"flesh_volume_ratio", "flesh volume", 4},
    {"total_volume_ratio", "total volume", 4},
    {"depth_rms_over_te", "depth/t_e", 3},
    {"wavelength_over_te", "wave/t_e", 2},
    {"valleys", "valleys", 0},
    {"ridge_meridian_alignment", "alignment", 3},
};

std::string cell(const json& value, int digits) {
    return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), digits) : "-";
}

/// A number as it is, whole numbers without a point.
std::string plain(const json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.dump();
}

void print_table(const json& measures) {
    for (const Column& column : kColumns)
        fmt::print("{:>{}}", column.title, std::string(column.title).size() + 2);
    fmt::print("\n");
    for (const json& frame : measures.value("frames", json::array())) {
        for (const Column& column : kColumns)
            fmt::print("{:>{}}", cell(frame.value(column.key, json()), column.digits),
                       std::string(column.title).size() + 2);
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
        app.add_subcommand("measure", "Measure a take: wave lengths, depth, valleys, volumes");
    const auto options = std::make_shared<Options>();
    command->add_option("TAKE", options->take, "The take's folder")->required();
    command->add_flag("--json", options->as_json, "Everything, for programs");
    command->footer(
        "Examples:\n"
        "  windfall measure jujube-seed1.take\n"
        "  windfall measure jujube-seed1.take --json | jq '.frames[-1].valleys'\n"
        "docs/measures.md defines every number.");
    command->callback([options] {
        const take::TakeReader take(options->take);
        if (take.info().process != "drying")
            throw InputError(fmt::format("{}: a take of \"{}\", of which nothing can be measured yet",
                                         options->take, take.info().process));
        const json measures = drying::measure(take);
        if (options->as_json)
            fmt::print("{}\n", measures.dump(2));
        else
            print_table(measures);
    });
}

}  // namespace windfall::cli
