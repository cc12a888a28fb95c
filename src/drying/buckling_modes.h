#pragma once
// Linear buckling (Liu et al. 2015, eq. (11)) about an equilibrium on the way.
#include <vector>

#include "core/run_context.h"
#include "drying/parameters.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

struct BucklingModes {
    std::vector<double> critical_shrinkage;          ///< rising
    std::vector<std::vector<geometry::Vec3>> modes;  ///< per mode: [column * layers + k], largest component 1
};

/// The lowest `imperfection.modes` buckling modes of the perfect mesh, linearised about
/// `imperfection.linearize_at`. The tangent K(s) is taken from equilibria at s0 and a little beyond, K(s) =
/// K0 + (s - s0) K1; the modes solve (K0 + (s - s0) K1) p = 0 by Lanczos in the inner product of K0
/// (Spectra), K0^-1 being applied by the multigrid. Throws RunError where K0 is not definite (the fruit has
/// buckled before s0).
BucklingModes find_buckling_modes(const geometry::LayeredMesh& mesh, const DryingParameters& parameters,
                                  const RunContext& context);

}  // namespace windfall::drying
