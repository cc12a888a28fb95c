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

/// The lowest `imperfection.modes` buckling modes of the perfect mesh, linearised between the tangents K0 and
/// K1 of its equilibria at s0 = `imperfection.linearize_at` and s1 a little beyond: K(s) = K0 - (s - s0) /
/// (s1 - s0) (K0 - K1) loses its definiteness at s_cr = s0 + (s1 - s0) / lambda, (K0 - K1) p = lambda K0 p.
/// Lanczos (Spectra) in the inner product of K0, whose inverse is applied by the multigrid. Throws RunError
/// where the fruit has buckled before s0.
BucklingModes find_buckling_modes(const geometry::LayeredMesh& mesh, const DryingParameters& parameters,
                                  const RunContext& context);

}  // namespace windfall::drying
