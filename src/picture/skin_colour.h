#pragma once
// The colour of a fruit's skin, point by point.
#include <vector>

#include "picture/look.h"
#include "picture/scene.h"

namespace windfall::picture {

/// Linear colour of three sRGB numbers as an artist types them.
Vec3f linear_colour(const std::vector<double>& srgb);

/// What is known of a point of the skin. Lengths in radii of the fresh fruit.
struct SkinPoint {
    Vec3f fresh_place;  ///< in the fresh fruit: patches stick to the skin while it moves
    float depth = 0;    ///< below the smooth surface; negative on ridges
    float dryness = 0;  ///< 0 .. 1: from the fresh to the dry colour
};

std::vector<Vec3f> skin_colours(const Look& look, const std::vector<SkinPoint>& points);

/// Tilts unit normals as the fine unevenness of the skin would; a fresh skin is four times as even as a dry
/// one.
void roughen_normals(const Look& look, const std::vector<SkinPoint>& points, std::vector<Vec3f>& normals);

}  // namespace windfall::picture
