#pragma once
#include <filesystem>
#include <string>

namespace windfall::meshfile {

/// The name of a texture's file, relative to `from`, as seen from the folder `to`. Absolute names and web
/// addresses stay what they are, and so does everything when the folders are the same.
std::string moved_texture(const std::string& name, const std::filesystem::path& from,
                          const std::filesystem::path& to);

/// Whether the file that another file in `folder` names lies in that folder or below it, links followed. A
/// mesh from elsewhere has no business with other files.
bool lies_below(const std::string& name, const std::filesystem::path& folder);

}  // namespace windfall::meshfile
