#pragma once
// The fine structure of bark and wood, which no mesh has: colour and unevenness as functions of the place in
// the rest shape, so that they stick to the wood while it moves.
#include "picture/scene.h"
#include "picture/surfaces.h"

namespace windfall::picture {

/// What a grain does at a place.
struct GrainValue {
    Vec3f tint = Vec3f::Ones();   ///< factor of the colour
    Vec3f slope = Vec3f::Zero();  ///< gradient of the height in the rest shape
};

/// `rest` in units of the branch's radius, the branch along y; of the pores for peel.
GrainValue grain_at(Grain grain, const Vec3f& rest);

/// Tints and tilts a point of a surface as its finish says; nothing where that has no grain.
void apply_grain(SurfacePoint& point);

}  // namespace windfall::picture
