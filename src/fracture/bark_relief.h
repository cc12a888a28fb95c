#pragma once
// Furrows of the bark.
#include <cmath>
#include <cstdint>

#include "fracture/noise.h"

namespace windfall::fracture {

/// Plates of bark with furrows between them: two sizes of ridged noise, stretched along the axis, periodic in
/// the angle.
struct BarkRelief {
    std::uint32_t coarse_seed = 0, fine_seed = 0;
    float depth = 0, scale = 1;  ///< radii; 1: about seven plates around

    BarkRelief(std::uint32_t seed, double relief_depth, double relief_scale)
        : coarse_seed(noise_key(seed, NoisePurpose::Bark, 0)),
          fine_seed(noise_key(seed, NoisePurpose::Bark, 1)),
          depth(static_cast<float>(relief_depth)),
          scale(static_cast<float>(relief_scale)) {}

    /// Radius of the bark over the mean one at (cos_angle, sin_angle, z): 1 - 1.4 depth .. 1 + 0.6 depth.
    float factor(float cos_angle, float sin_angle, float z) const {
        const float x = 2.2F * scale * cos_angle, y = 2.2F * scale * sin_angle, h = scale * z;
        const float coarse = gradient_noise(coarse_seed, 3 * x + 0.25F * h, 3 * y + 3.1F + 0.21F * h);
        const float fine = gradient_noise(fine_seed, 7 * x + 0.5F * h, 7 * y - 0.45F * h);
        const float ridged = std::abs(0.6F * coarse + 0.4F * fine);
        return 1 + depth * (0.6F - 2 * (ridged < 1 ? ridged : 1.0F));
    }
};

}  // namespace windfall::fracture
