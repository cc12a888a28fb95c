#pragma once
// A brick's surface laid on a closed surface: quadrilaterals of about one size and square, also where the
// surface bends, bulges and narrows.
#include <vector>

#include "geometry/brick_surface.h"
#include "geometry/curved_surface.h"
#include "geometry/sphere_map.h"

namespace windfall::geometry {

/// The vertices of a brick as spots of a surface.
struct LaidBrick {
    BrickSurface brick;
    std::vector<SurfaceSpot> spots;

    std::vector<Vec3> positions() const;
};

/// Lays a brick of cells[1] cells along the line between the surface's ends on it: first by the sphere map,
/// coarsely, then relaxed (`relax`), refined twofold and relaxed again until it has the cells asked for.
/// `map` is of the surface's triangles.
LaidBrick lay_brick(const CurvedSurface& surface, const SphereMap& map, const Lattice& cells);

/// Lays the brick with half the cells of `fine`, whose spots are known, out to `fine`: new vertices halfway
/// between the old ones and then on the surface. Throws InputError where the surface lies nowhere near.
LaidBrick refined(const CurvedSurface& surface, const LaidBrick& coarse, const BrickSurface& fine);

/// How the ends of a pass of `relax` are set: sweeps at most, fewer when nothing moves any more.
struct RelaxSettings {
    int sweeps = 40;
    /// Width of the barrier against turned-over corners, in areas of a quadrilateral: wide unfolds, narrow
    /// holds.
    double barrier = 0.05;
};

/// Moves the vertices along the surface towards squares of one size: Gauss-Seidel on the cube of the
/// symmetric Dirichlet energy of the corners, (|a|^2 + |b|^2)(1 + 1/|a x b|^2)/4 in units of the mean
/// quadrilateral's edge, edges weighted by 1 + 0.15 (1 - n.n') so that vertices gather where the surface
/// bends. In colours: the same bits on any number of threads.
void relax(const CurvedSurface& surface, LaidBrick& laid, const RelaxSettings& settings);

/// Length of a brick over its width whose edges on the surface vary least: one of 1, 1.5, 2, 3, 4, 6.
double best_elongation(const CurvedSurface& surface, const SphereMap& map);

}  // namespace windfall::geometry
