#pragma once
// How strongly motion from increment to increment is damped (docs/drying.md, "Viscosity").
#include "drying/parameters.h"

namespace windfall::drying {

/// The viscosity at a shrinkage: `solver.viscosity` while wrinkles appear, later that of wrinkles that stand.
/// `onset`: shrinkage at which they appeared; negative: not yet.
double viscosity(const DryingParameters& parameters, double shrinkage, double onset);

}  // namespace windfall::drying
