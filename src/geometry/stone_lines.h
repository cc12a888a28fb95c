#pragma once
// Which point of a stone belongs to which point of the skin around it.
#include "geometry/laid_brick.h"

namespace windfall::geometry {

/// Sweeps of `relax` on the stone: on the coarsest brick and on each finer one. Relaxing makes squares of the
/// stone's quadrilaterals and moves them away from those of the skin to which they belong.
struct StoneRelaxation {
    int coarsest = 0;
    int finer = 0;
};

/// The brick of `laid`, carried inwards to a stone: a coarse one along lines of steepest descent of the
/// potential d_stone / (d_skin + d_stone), d being distances, which stands in for the harmonic one (1 on the
/// skin, 0 on the stone); then relaxed on the stone and refined to the cells of `laid`, relaxed again.
LaidBrick brick_on_stone(const CurvedSurface& surface, const LaidBrick& laid, const CurvedSurface& stone,
                         const StoneRelaxation& relaxation);

/// Throws InputError with the place unless the stone lies inside the surface, nowhere nearer to it than
/// `distance`.
void require_inside(const CurvedSurface& surface, const CurvedSurface& stone, double distance);

}  // namespace windfall::geometry
