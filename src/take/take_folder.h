#pragma once
// Names in a take folder, and take.json.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "take/array_file.h"
#include "take/take_info.h"
#include "take/take_status.h"

namespace windfall::take {

/// No sound JSON or TOML file of a take comes near this.
inline constexpr std::uint64_t kMaxTextBytes = std::uint64_t{256} << 20;

std::filesystem::path mesh_path(const std::filesystem::path& folder, const std::string& name);
std::filesystem::path frame_path(const std::filesystem::path& folder, int index);
std::filesystem::path checkpoint_path(const std::filesystem::path& folder);
std::filesystem::path recipe_path(const std::filesystem::path& folder);
std::filesystem::path summary_path(const std::filesystem::path& folder);

/// Whether `name` may be the name of a mesh, and so of a file: letters, digits, '_' and '-', at most 64.
bool is_mesh_name(const std::string& name);

/// What stands in take.json and recipe.toml.
struct TakeHeader {
    TakeInfo info;
    TakeStatus status = TakeStatus::Running;
    std::string reason;
    std::vector<std::string> mesh_names;
};

/// Whether there is a take.json in `folder`, sound or not.
bool has_header(const std::filesystem::path& folder);

/// InputError when `folder` is not a take, or was written by a newer program.
TakeHeader read_header(const std::filesystem::path& folder);

/// Writes take.json. RunError when it cannot be written; see write_whole_file for `how_to_go_on`.
void write_header(const std::filesystem::path& folder, const TakeHeader& header,
                  std::string_view how_to_go_on);

/// An array file of a take. InputError when it cannot be read or is not sound.
ArrayFile read_array_file(const std::filesystem::path& path);

bool has_checkpoint(const std::filesystem::path& folder);

/// The process's own bytes in checkpoint.wfa. InputError as above.
std::vector<std::byte> read_checkpoint(const std::filesystem::path& folder);

/// What lies in a folder, in no order; nothing when it is not there or cannot be read.
std::vector<std::filesystem::path> folder_entries(const std::filesystem::path& folder);

/// The indices of the frame files there are, sorted.
std::vector<int> frame_indices(const std::filesystem::path& folder);

/// Removes all that a run put into `folder` besides take.json and recipe.toml; the checkpoint goes first, so
/// that nothing can go on from a take that is half removed. RunError when a file cannot be removed.
void remove_run(const std::filesystem::path& folder);

/// Removes what a killed program left under temporary names. Only for the holder of the lock.
void remove_temporaries(const std::filesystem::path& folder);

}  // namespace windfall::take
