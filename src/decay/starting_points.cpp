#include "decay/starting_points.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"

namespace windfall::decay {

std::vector<std::size_t> painted_texels(const geometry::CubeAtlas& atlas, std::span<const float> weight,
                                        std::size_t count, std::uint64_t seed, std::uint32_t fruit) {
    std::vector<double> up_to(weight.size());
    double sum = 0;
    for (std::size_t i = 0; i < weight.size(); ++i)
        up_to[i] = sum += atlas.covered(i) ? std::max(weight[i], 0.0F) : 0.0F;
    if (!(sum > 0))
        throw InputError("start.mask has no bright texel on the fruit: paint where it is wounded");
    std::vector<std::size_t> texels;
    for (std::size_t k = 0; k < count; ++k) {
        const double u = random_uniform4(seed, RandomPurpose::RotWounds, k, fruit)[2];
        // The first whose sum lies above: one whose own weight is not 0.
        texels.push_back(
            static_cast<std::size_t>(std::upper_bound(up_to.begin(), up_to.end(), u * sum) - up_to.begin()));
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
