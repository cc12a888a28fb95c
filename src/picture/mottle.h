#pragma once
// Smooth noise in space, for patches on the skin.
#include <cstdint>

#include "picture/scene.h"

namespace windfall::picture {

/// Smooth noise of one length scale (1), about -1 .. 1 with mean 0. A function of the place alone.
float smooth_noise(const Vec3f& place, std::uint64_t seed);

/// Three octaves of `smooth_noise`, about -1 .. 1.
float mottle_noise(const Vec3f& place, std::uint64_t seed);

}  // namespace windfall::picture
