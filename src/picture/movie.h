#pragma once
// Movies, by the program ffmpeg where it is installed.
#include <filesystem>
#include <string>

#include "core/run_context.h"

namespace windfall::picture {

/// Makes `movie` (MP4, H.264) of `count` pictures 0000.png, 0001.png ... in `folder`, replacing one that is
/// there. Returns false when there is no such program. Throws RunError with its words when it fails,
/// Cancelled.
bool make_movie(const std::string& ffmpeg, const std::filesystem::path& folder, int count,
                double frames_per_second, const std::filesystem::path& movie, const RunContext& context);

}  // namespace windfall::picture
