#pragma once
// Fruit in segments, like a mandarin or a pepper: walls through the axis, stiffer than the flesh between them
// and shrinking less.
#include <vector>

#include "drying/elasticity.h"
#include "drying/parameters.h"

namespace windfall::drying {

/// For every quad of the brick the part of its columns' flesh that is wall, from 0 to 1; empty without
/// segments. Walls stand at even longitudes; the quads on the axis hold as much of them as all others on the
/// mean.
std::vector<double> wall_parts(const geometry::LayeredMesh& mesh, const SegmentParameters& segments);

/// Moduli of the flesh of every quad over those of flesh without walls; empty without walls.
std::vector<double> wall_stiffening(const std::vector<double>& walls, const SegmentParameters& segments);

/// The drying part Fd with walls in the flesh that shrink by `segments.wall_shrinkage` of what flesh does.
/// Keeps a reference to `walls`.
DryingField with_walls(DryingField drying, const std::vector<double>& walls,
                       const SegmentParameters& segments, int flesh_layers);

}  // namespace windfall::drying
