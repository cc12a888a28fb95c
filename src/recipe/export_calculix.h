#pragma once
// What a take was made from, as an input deck of CalculiX.
#include <filesystem>

#include "core/run_context.h"

namespace windfall::recipe {

/// Writes the CalculiX deck (drying/calculix_deck.h) of the recipe in the take's folder to `output`: a file
/// whose name ends in ".inp", or a folder, which is made. Returns the file. Without `overwrite` a file that
/// exists is an InputError. Throws RunError when it cannot be written.
std::filesystem::path export_calculix(const std::filesystem::path& take_folder,
                                      const std::filesystem::path& output, bool overwrite,
                                      const RunContext& context);

}  // namespace windfall::recipe
