#pragma once
// Where a closed surface has a way through.
#include <vector>

#include "geometry/surface_check_edges.h"

namespace windfall::geometry {

/// Vertices of a short loop that cannot be drawn together on the surface; empty where there is none. All
/// edges must be sound. From the loops of a tree and a cotree (Erickson and Whittlesey 2005, Greedy optimal
/// homotopy and homology generators), with one root instead of all: short, but not always the shortest.
std::vector<std::int32_t> handle_loop(const SurfaceEdges& edges, std::size_t vertices, std::size_t triangles);

}  // namespace windfall::geometry
