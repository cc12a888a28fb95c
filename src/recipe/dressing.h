#pragma once
// What pictures and exports add to the frames of a take.
#include <functional>

#include "take/take_reader.h"

namespace windfall::recipe {

/// Adds shading maps and mold to the frames of a rotten fruit; empty for takes of other processes. Keeps what
/// it has worked out for the take's meshes.
std::function<void(take::Frame&)> dressing(const take::TakeReader& take);

}  // namespace windfall::recipe
