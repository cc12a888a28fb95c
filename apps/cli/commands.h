#pragma once
// The commands, each in its own file. A command adds its options to the program and runs when the arguments
// are parsed; errors leave it as exceptions, which main turns into texts and exit codes.
#include <CLI/CLI.hpp>

namespace windfall::cli {

void add_dry(CLI::App& app);
void add_snap(CLI::App& app);
void add_rot(CLI::App& app);
void add_presets(CLI::App& app);
void add_schema(CLI::App& app);
void add_doctor(CLI::App& app);
void add_show(CLI::App& app);
void add_export(CLI::App& app);
void add_measure(CLI::App& app);

}  // namespace windfall::cli
