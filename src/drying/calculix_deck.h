#pragma once
// The same body, law and drying as an input deck of CalculiX, a finite-element program of its own, so that
// results can be compared node by node. It agrees up to the onset of wrinkles; beyond, CalculiX stalls.
#include <string>

#include "drying/parameters.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// Number of a node in the deck; `level` 0 is on the stone, `mesh.layers` on the skin.
int calculix_node(const geometry::LayeredMesh& mesh, std::size_t vertex, int level);

/// The deck: C3D8 elements in the sets FLESH and SKIN, node sets ALL, STONE (fixed) and SKIN_SURFACE, whose
/// displacements are printed at the end of the drying. Lengths in r_1, stresses in C0 of the flesh. `mesh` is
/// the fresh body, imperfection included. Throws InputError for anisotropic drying, which the deck's thermal
/// expansion cannot express, and for walls and fibres.
std::string calculix_deck(const geometry::LayeredMesh& mesh, const DryingParameters& parameters);

}  // namespace windfall::drying
