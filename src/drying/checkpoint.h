#pragma once
// The state of a path as bytes: all that the way ahead depends on, to the last bit.
#include <cstddef>
#include <span>
#include <vector>

#include "drying/drying_path.h"

namespace windfall::drying {

struct Checkpoint {
    PathState path;
    int frames_done = 0;
    double elapsed_s = 0;  ///< of the runs so far
};

std::vector<std::byte> to_bytes(const Checkpoint& checkpoint);

/// Throws InputError where the bytes are not a checkpoint of vectors of `vector_size` numbers and a course
/// that keeps `course_size` of them.
Checkpoint checkpoint_from(std::span<const std::byte> bytes, std::size_t vector_size,
                           std::size_t course_size = 0);

}  // namespace windfall::drying
