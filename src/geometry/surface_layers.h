#pragma once
// From a brick laid on a closed surface to columns of hexahedra under it: skin along the normals, flesh along
// straight lines to a stone.
#include <vector>

#include "geometry/laid_brick.h"
#include "geometry/layered_mesh.h"

namespace windfall::geometry {

/// What all ways inwards start from. Lengths in the surface's unit.
struct SurfaceColumns {
    const CurvedSurface& surface;
    const LaidBrick& laid;
    std::vector<Vec3> directions;  ///< on the sphere map, unit
    double skin_thickness = 0;     ///< the outermost part inside the surface
    LayerFractions fractions;
};

/// How deep a made stone lies, as shares of the medial radius: the first of `shares` whose hexahedra all are
/// sound, else the soundest.
struct MadeStone {
    std::vector<double> shares;
};
inline const MadeStone kAutomaticStone{{0.6, 0.5, 0.4, 0.3}};
inline const MadeStone kSmallCore{{0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3}};

/// A stone of the body's own shape. The medial radius is taken at every fourth line of the lattice, made to
/// vary by at most 0.3 of the way and smoothed; lines run along normals smoothed three times. Throws
/// InputError with the place where a hexahedron folds over.
LayeredMesh layers_to_made_stone(const SurfaceColumns& columns, const MadeStone& stone);

/// To a core as small as the layers allow, which stands in for no stone, since something must hold the body:
/// a quarter of the way from the centre along the lines of `SphereInterior`; where these fold over or lie too
/// oblique to the skin, as `layers_to_made_stone` with up to 0.9 of the medial radius. Throws InputError as
/// that does.
LayeredMesh layers_to_core(const SurfaceColumns& columns, const SphereMap& map);

/// To a stone that is given. Ends of the lines of steepest descent of (distance to the skin)-like harmonic
/// potential, from a coarse brick, are relaxed on the stone and refined with it; then straight lines. Throws
/// InputError with the place where the stone comes nearer to the surface than twice the skin, and where a
/// hexahedron folds over.
LayeredMesh layers_to_stone(const SurfaceColumns& columns, const CurvedSurface& stone);

}  // namespace windfall::geometry
