#pragma once
// Hair for rays (Embree's round linear curves). For surfaces.cpp.
#include <embree3/rtcore.h>

#include "picture/surfaces.h"

namespace windfall::picture {

/// A mesh is seen by all rays, hair by those alone that look for the first surface.
inline constexpr unsigned kMeshMask = 1, kHairMask = 2;

/// Adds hair to a scene that is not committed yet, as geometry `id`.
void attach_hair(RTCDevice device, RTCScene scene, const SceneHair& hair, unsigned id);

/// The point of a segment (its number in Embree) that a ray met. `geometric_normal`: Embree's, any length.
SurfacePoint hair_point(const SceneHair& hair, unsigned segment, const Vec3f& place, float distance,
                        const Vec3f& geometric_normal, const Vec3f& direction);

}  // namespace windfall::picture
