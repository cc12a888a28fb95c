#pragma once
#include "geometry/surface_mesh.h"

namespace windfall::decay {

/// A bowl as something to look at, z up: the part of a sphere's inside that bowl_ground() stands for, with a
/// rounded rim, an outside and a foot. A closed surface, faces counter-clockwise from outside.
geometry::SurfaceMesh bowl_mesh(double radius_m, double height_m);

}  // namespace windfall::decay
