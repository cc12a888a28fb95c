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

}  // namespace windfall::meshfile
