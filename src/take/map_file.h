#pragma once
// Maps of a frame as 16-bit PNG files beside the frames, where any painting or rendering program can take
// them.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "take/frame.h"
#include "take/whole_file.h"

namespace windfall::take {

/// How much time goes into making a file small.
enum class MapEffort {
    Fast,   ///< for runs: about 1 ms a map of 512 x 512
    Small,  ///< for files that stay: ten times as long, a tenth to a third smaller
};

/// The bytes of a PNG file: grey, RGB or RGBA, 16 bits. std::logic_error when the values do not fit the size;
/// RunError when libspng fails.
std::vector<std::byte> encode_map(const FrameMap& map, MapEffort effort = MapEffort::Fast);

/// Puts the values of a PNG file into `map`, whose width, height and components it must have. InputError with
/// `file_name` when it has not or is damaged.
void decode_map(std::span<const std::byte> bytes, const std::string& file_name, FrameMap& map);

/// maps/MESH/NAME/0012.png; without a mesh maps/NAME/0012.png.
std::filesystem::path map_path(const std::filesystem::path& folder, const FrameMap& map, int frame);

/// The files of the maps of a frame, made on several threads, and their folders. std::logic_error when a name
/// cannot be that of a folder or two maps share theirs.
std::vector<WholeFile> map_files(const std::filesystem::path& folder, const Frame& frame);

/// Reads the values of the maps that a frame describes. InputError when a file is missing or damaged.
void read_maps(const std::filesystem::path& folder, Frame& frame);

/// Removes the maps of all frames.
void remove_maps(const std::filesystem::path& folder);

/// Removes what a killed program left of maps under temporary names.
void remove_map_temporaries(const std::filesystem::path& folder);

}  // namespace windfall::take
