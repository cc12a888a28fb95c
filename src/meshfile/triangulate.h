#pragma once
#include <array>
#include <vector>

#include "meshfile/mesh.h"

namespace windfall::meshfile {

/// The face as triangles of corners (indices into mesh.corners), turned as the face is: ears are clipped in
/// the plane of its vector area (Meisters 1975); a polygon that has no ear because it crosses itself is cut
/// into a fan.
std::vector<std::array<std::size_t, 3>> triangulated(const Mesh& mesh, std::size_t face);

}  // namespace windfall::meshfile
