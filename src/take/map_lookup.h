#pragma once
// Values of maps between the texels.
#include <array>

#include "take/frame.h"

namespace windfall::take {

/// Bilinear value at texture coordinates, 0 .. 1 (of `minimum` .. `maximum`), all components; those that the
/// map has not are 0. Outside of the map the texels of its border go on. NaN coordinates count as 0.
std::array<float, 4> map_values(const FrameMap& map, float u, float v);

/// The first component.
float map_value(const FrameMap& map, float u, float v);

}  // namespace windfall::take
