#pragma once
// The recipes that ship with the program.
#include <filesystem>
#include <string>
#include <vector>

namespace windfall::recipe {

/// Folder of the shipped presets: beside the running program (PREFIX/share/windfall/presets for
/// PREFIX/bin/windfall), else where it was configured to be installed, else in the source tree. Throws
/// InputError when none of them is there.
std::filesystem::path preset_folder();

/// Names of the shipped presets, sorted.
std::vector<std::string> preset_names();

/// File of a shipped preset. Throws InputError with the nearest names when there is no such preset.
std::filesystem::path preset_file(const std::string& name);

}  // namespace windfall::recipe
