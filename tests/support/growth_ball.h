#pragma once
#include <memory>
#include <vector>

#include "decay/growth.h"

namespace windfall::decay {

/// Positions of the texels of a ball; `stretch` pulls the directions apart along z, and with them the texels.
inline std::vector<geometry::Vec3> ball_positions(const geometry::CubeAtlas& atlas, double radius_m,
                                                  double stretch = 1) {
    std::vector<geometry::Vec3> positions(atlas.texel_count(), geometry::Vec3::Zero());
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (atlas.covered(i))
            positions[i] =
                radius_m * atlas.texel_direction(i).cwiseProduct(geometry::Vec3(1, 1, stretch)).normalized();
    return positions;
}

/// Soft rot and green mould.
inline std::vector<Organism> rot_and_mould() {
    return {soft_rot_organism(species_named("erwinia")),
            fungus_organism(species_named("penicillium-digitatum"))};
}

/// No noise of any kind.
inline GrowthSettings even_settings() {
    GrowthSettings settings;
    settings.motility_noise = settings.nutrient_noise = settings.step_noise = 0;
    return settings;
}

/// A ball of 35 mm with its growth.
struct GrowthBall {
    explicit GrowthBall(int side, const GrowthSettings& settings = {}, std::uint64_t seed = 7,
                        const GrowthFields& fields = {}, double stretch = 1)
        : atlas(side),
          growth(atlas, ball_positions(atlas, 0.035, stretch), rot_and_mould(), settings, seed, fields) {}

    std::size_t texel(const geometry::Vec3& direction) const {
        return growth.nearest_texel(0.035 * direction.normalized());
    }

    geometry::CubeAtlas atlas;
    Growth growth;
};

}  // namespace windfall::decay
