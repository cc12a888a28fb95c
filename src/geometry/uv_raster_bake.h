#pragma once
// Maps in a cube atlas over into the artist's own texture.
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cube_atlas.h"
#include "geometry/sphere_map.h"
#include "geometry/uv_raster.h"

namespace windfall::geometry {

/// Immutable; safe to use from several threads.
class AtlasBake {
  public:
    /// Finds where each texel of the artist's texture lies in the atlas.
    AtlasBake(const UvRaster& raster, const SphereMap& map, const CubeAtlas& atlas);

    /// Bilinear values of an atlas map in the artist's texture, raster.size() squared x channels values, top
    /// row first; texels that no face covers keep what `result` holds. The map must have been bled. Throws
    /// InputError when the sizes do not fit.
    void bake(std::span<const float> atlas_map, std::span<float> result, int channels = 1) const;

  private:
    struct Tap {
        std::uint32_t texel;  ///< of the artist's texture
        std::uint32_t first;  ///< upper left of four neighbours in the atlas
        float right, down;    ///< share of the right and of the lower ones
    };
    int m_atlas_side;
    std::size_t m_texels;
    std::vector<Tap> m_taps;
};

}  // namespace windfall::geometry
