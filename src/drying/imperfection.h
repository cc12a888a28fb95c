#pragma once
// The flaw that lets wrinkles start: the fresh shape is displaced by at most chi = imperfection.amplitude
// (Liu et al. 2015, section 4.3: X' = X + chi p, the largest component of p being 1).
#include "core/run_context.h"
#include "drying/parameters.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// Displaces the nodes of `mesh` along the columns' directions by band-limited noise; full on the skin,
/// falling with the square of the height above the stone below it.
void add_noise(geometry::LayeredMesh& mesh, const DryingParameters& parameters);

/// Displaces the nodes of `mesh` by a random mix of the lowest buckling modes (see buckling_modes.h).
void add_modes(geometry::LayeredMesh& mesh, const DryingParameters& parameters, const RunContext& context);

/// The one that the parameters name.
void add_imperfection(geometry::LayeredMesh& mesh, const DryingParameters& parameters,
                      const RunContext& context);

}  // namespace windfall::drying
