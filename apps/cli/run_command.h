#pragma once
// What the commands that run a recipe (dry, snap) have in common: options, texts, the way to a take.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace windfall::cli {

class ProgressPrinter;

struct RunOptions {
    std::string recipe;  ///< a preset's name or a recipe's path; of `snap` also a tree's
    std::vector<std::string> settings;
    std::string output;
    std::string progress;
    std::optional<std::int64_t> seed;
    int threads = 0;
    bool resume = false, force = false, no_pictures = false, dry_run = false;

    /// Those of --set, and --seed behind them.
    std::vector<std::string> all_settings() const;
};

/// Adds the options of a command that runs recipes of `process`; `options` must live as long as `command`.
void add_run_options(CLI::App& command, RunOptions& options, const std::string& process);

/// Runs the recipe, which must be of `process`, into a take and draws it, or only tells what would be run.
/// Errors leave it as exceptions, after a last word to --progress.
void run_recipe(const RunOptions& options, const std::string& process);

/// Calls `run` with the printer of that kind, and tells the printer when an exception leaves it.
void run_and_report(const std::string& progress_kind, const std::function<void(ProgressPrinter&)>& run);

}  // namespace windfall::cli
