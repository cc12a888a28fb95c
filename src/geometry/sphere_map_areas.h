#pragma once
// Spreads a surface that lies on the unit sphere more evenly over it.
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// Moves the directions so that every part of the sphere holds about as much of the surface as any other.
/// First a Moebius map that takes the two ends of the surface to opposite poles, and latitudes about these by
/// area; then the same about many axes in turn. A pass that would turn a triangle over is taken by half, or
/// not at all.
void spread_areas(const TriangleSurface& surface, std::vector<Vec3>& directions);

/// The two ends of a surface: vertices that are the furthest apart along the edges, nearly.
std::array<std::int32_t, 2> ends_of(const TriangleSurface& surface);

/// Six times the signed volume between a triangle on the sphere and its centre: positive where it is not
/// turned over.
double sphere_orientation(const std::vector<Vec3>& directions, const Triangle& triangle);

}  // namespace windfall::geometry
