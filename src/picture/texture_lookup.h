#pragma once
// Maps on a surface: what they say where a ray meets it.
#include "picture/surfaces.h"
#include "take/frame.h"

namespace windfall::picture {

/// The shading maps of one mesh (export.md lists them). Maps without texels say nothing.
struct SurfaceTexture {
    take::FrameMap base_color, subsurface_color, roughness, normal, mold_mask;
};

/// The colour at texture coordinates, linear.
Vec3f texture_colour(const take::FrameMap& map, const Eigen::Vector2f& uv);

/// Gives a point of a textured mesh its roughness, gloss, softness and the fine tilt of its normal. Its
/// colour it has already. Points of other meshes stay as they are.
void apply_texture(SurfacePoint& point);

}  // namespace windfall::picture
