#pragma once
// What each part of the skin is exposed to while it dries: sun, shade, a painted map.
#include <functional>
#include <vector>

#include "drying/moisture_parameters.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// Brightness 0..1 of a painted picture at texture coordinates of the skin (v up); empty: white.
using SkinPaint = std::function<double(const geometry::Vec2&)>;

/// By quad of the skin.
struct SkinExposure {
    std::vector<double> transpiration;  ///< factor of it
    std::vector<double> sun;  ///< cosine between the fresh skin's normal and the sun, 0 where there is none
};

/// `uvs`: texture coordinates of the middles of the quads, read only where there is paint.
SkinExposure skin_exposure(const geometry::LayeredMesh& mesh, const MoistureParameters& parameters,
                           const SkinPaint& paint, const std::vector<geometry::Vec2>& uvs);

/// Texture coordinates of the middles of the quads in the solver's own atlas.
std::vector<geometry::Vec2> atlas_middles(const geometry::BrickSurface& brick);

/// Sunshine over its noon value, `hour` hours after a midnight: half a sine from 6 to 18 o'clock, or
/// always 1.
double daylight(Sunshine sunshine, double hour);

}  // namespace windfall::drying
