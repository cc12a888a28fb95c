#pragma once
// Files are written whole or not at all: under a temporary name in the same folder, then renamed.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace windfall::take {

/// What a message about a failed write tells the user to do once the cause is gone.
inline constexpr std::string_view kRunAgain = "run the command again";

/// Replaces `path` by a file with these bytes, or leaves it as it was and throws RunError: which file, why,
/// what to do
/// (`how_to_go_on` ends the message). Two programs writing one path do not mix their bytes; the last one
/// wins.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                      std::string_view how_to_go_on = kRunAgain);
void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      std::string_view how_to_go_on = kRunAgain);

struct WholeFile {
    std::filesystem::path path;
    std::vector<std::byte> bytes;
};

/// The same for several files. The disk is asked to keep all of them at once, which takes hardly longer than
/// for one; then they get their names in the order given. When one cannot be written, none gets its name.
void write_whole_files(const std::vector<WholeFile>& files, std::string_view how_to_go_on = kRunAgain);

/// Writes all bytes to an open file descriptor; returns 0 or the errno of the failure.
int write_all(int descriptor, std::span<const std::byte> bytes);

/// Whether `file_name` is a temporary name of `write_whole_file`, left behind by a program that was killed.
bool is_temporary_name(const std::string& file_name);

/// The bytes of a file. InputError when it cannot be read, is not a regular file or is larger than
/// `max_bytes`.
std::vector<std::byte> read_whole_file(const std::filesystem::path& path, std::uint64_t max_bytes);
std::string read_whole_text(const std::filesystem::path& path, std::uint64_t max_bytes);

/// Makes `folder` (and the folders above it) where it is not there. InputError when that cannot be, or when
/// new files cannot be put into it.
void make_writable_folder(const std::filesystem::path& folder);

}  // namespace windfall::take
