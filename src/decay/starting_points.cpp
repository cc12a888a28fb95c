#include "decay/starting_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "decay/growth_noise.h"

namespace windfall::decay {

std::vector<std::size_t> painted_texels(const Growth& growth, std::span<const float> weight,
                                        std::size_t count, std::uint64_t seed) {
    if (weight.size() != growth.texel_count())
        throw InputError(fmt::format("a painted map of {} values does not fit the texture of {} texels",
                                     weight.size(), growth.texel_count()));
    std::vector<double> up_to(weight.size());
    double sum = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
        sum += static_cast<double>(std::max(weight[i], 0.0F)) * growth.areas_m2()[i];
        up_to[i] = sum;
    }
    if (!(sum > 0 && std::isfinite(sum)))
        throw InputError("the painted map marks no place on the skin: paint where rot is to begin");
    std::vector<std::size_t> texels;
    for (std::size_t k = 0; k < count; ++k) {
        const double at = sum * unit_interval(noise_stream(seed, GrowthNoise::Painted, k));
        // The first whose sum lies above: one whose own weight is not 0.
        texels.push_back(
            static_cast<std::size_t>(std::upper_bound(up_to.begin(), up_to.end(), at) - up_to.begin()));
    }
    return texels;
}

void wet_around(const geometry::CubeAtlas& atlas, std::span<const geometry::Vec3> texel_positions_m,
                const geometry::Vec3& point_m, double radius_m, std::span<float> wetness) {
    for (const geometry::CubeAtlas::Run& run : atlas.runs()) {
        for (std::size_t i = run.begin; i < run.end; ++i) {
            const double t = std::clamp(2 - (texel_positions_m[i] - point_m).norm() / radius_m, 0.0, 1.0);
            wetness[i] = std::max(wetness[i], static_cast<float>(t * t * (3 - 2 * t)));
        }
    }
}

}  // namespace windfall::decay
