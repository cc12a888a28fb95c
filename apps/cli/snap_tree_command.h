#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "run_command.h"

namespace windfall::cli {

/// What `windfall snap` needs besides when its first argument is a tree.
struct TreeOptions {
    std::string at;                    ///< "x,y,z"
    std::string recipe = "ailanthus";  ///< a preset's name or a recipe's path
    std::string up = "y";
    std::string falls = "away";
    double unit_m = 1;
};

/// Adds --at and what goes with it; `tree` must live as long as `command`.
void add_tree_options(CLI::App& command, TreeOptions& tree);

/// Breaks the tree `options.recipe` at `tree.at`, or only tells what is there. Errors leave it as exceptions,
/// after a last word to --progress.
void run_snap_tree(const RunOptions& options, const TreeOptions& tree);

}  // namespace windfall::cli
