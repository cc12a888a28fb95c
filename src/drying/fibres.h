#pragma once
// Fibres in the flesh or the skin, with a direction of their own: a fruit that is stiffer one way than
// across.
//
// The law is the standard reinforcing model (Qiu and Pence 1997; invariants of Spencer 1972; in tissues
// Holzapfel, Gasser and Ogden 2000): besides what the flesh has of its own, per volume of the drying,
//   W = E / 8 (I4 - 1)^2,  I4 = |F a0|^2 / |Ff a0|^2,
// a0 being the direction in the fresh fruit and Ff the drying of the fibres: I4 is the square of the stretch
// of a fibre that lies in the flesh as a line of its points, over the length it would have free of stress.
// Where a0 is a principal direction of the drying, as it is here, that is |Fe a0|^2. E is Young's modulus of
// small strains that the fibres add along themselves; across they add nothing.
//
// They resist being pressed as they resist being pulled: bundles that lie within flesh do not buckle alone,
// but only with the flesh around them (Rosen 1965), and that is in the model: where they are pressed by more
// than about mu / E, flesh and fibres kink together, at the scale of the mesh since nothing in the law has a
// length.
#include <Eigen/Core>
#include <vector>

#include "drying/elasticity.h"
#include "drying/parameters.h"

namespace windfall::drying {

/// Fibres of the recipe in a fresh body; none where `parameters` have none.
Fibres make_fibres(const geometry::LayeredMesh& mesh, const FibreParameters& parameters,
                   const LayerModuli& moduli);

}  // namespace windfall::drying
