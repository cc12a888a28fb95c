#pragma once
// Where rot begins: contacts, the stem scar, wounds that the artist picks or paints.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decay/growth.h"

namespace windfall::decay {

/// One place with one organism.
struct StartingPoint {
    geometry::Vec3 point_m = geometry::Vec3::Zero();  ///< the nearest texel is taken
    std::size_t organism = 0;                         ///< index into the Growth's organisms
    double strength = 0.3;                            ///< peak density planted, 0..1
    double radius_m = 0.0015;
};

/// `count` texels drawn with probabilities that go with `weight` (one value a texel, negative ones and those
/// of gutters count as 0; the atlas' texels are of nearly one size), keyed by seed, fruit and number. Texels
/// may repeat. Throws InputError when all weights are 0.
std::vector<std::size_t> painted_texels(const geometry::CubeAtlas& atlas, std::span<const float> weight,
                                        std::size_t count, std::uint64_t seed, std::uint32_t fruit);

/// Raises `wetness` (see GrowthFields) to 1 within the radius of a point, falling smoothly to 0 at twice
/// that.
void wet_around(const geometry::CubeAtlas& atlas, std::span<const geometry::Vec3> texel_positions_m,
                const geometry::Vec3& point_m, double radius_m, std::span<float> wetness);

}  // namespace windfall::decay
