#include "meshfile/texture_path.h"

namespace windfall::meshfile {

std::string moved_texture(const std::string& name, const std::filesystem::path& from,
                          const std::filesystem::path& to) {
    namespace fs = std::filesystem;
    if (name.empty() || fs::path(name).is_absolute() || name.find(':') != std::string::npos) return name;
    std::error_code failed;
    const fs::path old_folder = fs::weakly_canonical(fs::absolute(from), failed);
    const fs::path new_folder = fs::weakly_canonical(fs::absolute(to), failed);
    if (failed || old_folder == new_folder) return name;
    const fs::path moved = (old_folder / name).lexically_relative(new_folder);
    return moved.empty() ? name : moved.generic_string();
}

bool lies_below(const std::string& name, const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    if (fs::path(name).is_absolute()) return false;
    std::error_code failed;
    const fs::path root = fs::weakly_canonical(fs::absolute(folder), failed);
    if (failed) return false;
    const fs::path file = fs::weakly_canonical(root / name, failed);
    if (failed) return false;
    const fs::path way = file.lexically_relative(root);
    return !way.empty() && *way.begin() != "..";
}

}  // namespace windfall::meshfile
