#pragma once
// Whether a mesh is the skin of one solid body: closed, facing outwards, without handles, nowhere through
// itself.
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

enum class SurfaceDefectKind {
    Empty,             ///< no faces
    Degenerate,        ///< a face without area
    Hole,              ///< edges with one face
    Fin,               ///< edges with more than two faces
    FlippedFace,       ///< faces wound against their neighbours
    BowTie,            ///< a vertex in which two fans of faces touch
    SeveralBodies,     ///< a body besides the largest
    Handle,            ///< a way through, as in a ring
    InsideOut,         ///< faces are wound clockwise seen from outside
    SelfIntersection,  ///< faces that pass through each other
};

/// One connected piece of what is wrong.
struct SurfaceDefect {
    SurfaceDefectKind kind = SurfaceDefectKind::Empty;
    Vec3 place_m = Vec3::Zero();      ///< its middle
    std::vector<std::int32_t> faces;  ///< of the mesh, ascending
    std::string text;                 ///< what, where and the remedy
};

/// Everything that is wrong with a mesh, whose vertices count as welded where they lie in one place; kinds in
/// the order above. Throws InputError when a face points to no vertex or a position is not finite.
std::vector<SurfaceDefect> surface_defects(const SurfaceMesh& mesh);

/// Throws InputError naming the first few defects, if there are any; `name` is the file's.
void require_closed(const SurfaceMesh& mesh, const std::string& name);

}  // namespace windfall::geometry
