#include "recipe/presets.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/nearest_name.h"

namespace windfall::recipe {

namespace fs = std::filesystem;

fs::path preset_folder() {
    std::error_code ignored;
    std::vector<fs::path> candidates;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    if (!program.empty())
        candidates.push_back(program.parent_path().parent_path() / "share" / "windfall" / "presets");
    // The source tree goes before the install prefix: a program run from its build folder must not read the
    // presets of an older version that is installed as well.
    candidates.emplace_back(WINDFALL_SOURCE_PRESETS);
    candidates.emplace_back(WINDFALL_INSTALLED_PRESETS);
    for (const fs::path& folder : candidates)
        if (fs::is_directory(folder, ignored)) return folder;
    std::string places;
    for (const fs::path& folder : candidates) places += "\n  " + folder.string();
    throw InputError("the presets are not there: install Windfall anew, or name a recipe file. Looked in" +
                     places);
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(preset_folder()))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

fs::path preset_file(const std::string& name) {
    const std::vector<std::string> names = preset_names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return preset_folder() / (name + ".toml");
    std::error_code ignored;
    std::string remedy;
    std::vector<std::string> nearest = nearest_names(name, names, 3);
    for (const std::string& preset : names)  // a name that was not typed to its end
        if (nearest.empty() && name.size() > 1 && preset.starts_with(name)) nearest.push_back(preset);
    if (!nearest.empty())
        remedy = fmt::format("did you mean {}?", fmt::join(nearest, ", "));
    else
        remedy = fmt::format("there are {}", fmt::join(names, ", "));
    if (!name.empty() && fs::exists(name, ignored))
        remedy += fmt::format(" (a recipe file is named by its path: ./{})", name);
    throw InputError(fmt::format("there is no preset \"{}\"; {}", name, remedy));
}

}  // namespace windfall::recipe
