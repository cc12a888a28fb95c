#pragma once
// The state of growth as maps of a frame.
#include <string>
#include <vector>

#include "decay/growth.h"
#include "geometry/cube_atlas.h"
#include "geometry/uv_raster_bake.h"
#include "take/frame.h"

namespace windfall::decay {

/// nutrient, soft_rot, and of every fungus its density ("fungus", or "fungus_KEY" where there are several;
/// KEY is the part of the species' name behind its last hyphen) and its active share ("fungus_active",
/// "fungus_active_KEY"). Densities are active + inactive over theta n0, clipped to 1.
/// With a `bake` they are maps of its texture, `baked_size` texels a side, in place of the atlas.
std::vector<take::FrameMap> raw_maps(const geometry::CubeAtlas& atlas, const Growth& growth,
                                     const std::string& mesh, const geometry::AtlasBake* bake = nullptr,
                                     int baked_size = 0);

}  // namespace windfall::decay
