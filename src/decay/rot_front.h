#pragma once
// How fast a front runs over a surface: area that it takes a unit of time over its length.
#include <span>

#include "decay/growth.h"
#include "geometry/cube_atlas.h"

namespace windfall::decay {

/// With H rising from 0 to 1 between two densities, the coarea formula gives the mean area inside the level
/// sets between them as the integral of H, and their mean length as that of |grad H|.
struct Front {
    double area_m2 = 0, length_m = 0;
};

/// The front of a density (one value a texel) over the densities `low` to `high`.
Front front_of(const geometry::CubeAtlas& atlas, const Growth& growth, std::size_t organism, double low,
               double high);

}  // namespace windfall::decay
