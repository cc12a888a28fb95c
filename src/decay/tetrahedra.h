#pragma once
// The flesh as a solid mesh: layers of prisms below the surface of a cube mapped onto the fruit, each cut
// into three tetrahedra, and one vertex in the centre.
#include <array>
#include <cstdint>
#include <vector>

#include "decay/body.h"
#include "geometry/brick_surface.h"

namespace windfall::decay {

using Tetrahedron = std::array<std::int32_t, 4>;

struct FleshMesh {
    geometry::BrickSurface brick;
    int layers = 0;                       ///< of nodes, the surface included
    std::vector<geometry::Vec3> nodes;    ///< [layer * columns + column] from the surface in, then the centre
    std::vector<Tetrahedron> tetrahedra;  ///< positively oriented

    std::size_t columns() const { return brick.vertex_count(); }
    /// Column of a node; columns() for the centre.
    std::size_t column_of(std::size_t node) const {
        return node + 1 == nodes.size() ? columns() : node % columns();
    }
};

/// `cells` per edge of the cube, `layers` of nodes (>= 2). Layers grow thicker inwards; the innermost stands
/// at 22 % of the way from the centre. Throws InputError where a tetrahedron would be flat or inside out.
FleshMesh make_flesh_mesh(const SurfaceFunction& surface, const InteriorFunction& interior, int cells,
                          int layers);

/// Six times the signed volume of a tetrahedron.
double six_volume(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c,
                  const geometry::Vec3& d);

/// Every edge of the tetrahedra once, ends ascending, sorted.
std::vector<std::array<std::int32_t, 2>> edges_of(const std::vector<Tetrahedron>& tetrahedra);

/// The interior that shrinks the surface towards `centre`.
InteriorFunction towards_centre(const SurfaceFunction& surface, const geometry::Vec3& centre);

}  // namespace windfall::decay
