#pragma once
// The inside of a surface that lies on a sphere: one to one with the inside of the ball, also for bodies
// whose surface does not see their centre, such as a bent banana.
#include <vector>

#include "geometry/brick_surface.h"
#include "geometry/sphere_map.h"

namespace windfall::geometry {

/// Keeps a reference to the map, which must outlive it. Immutable; safe to read from several threads.
class SphereInterior {
  public:
    /// Lays a ball of hexahedra, `cells` along an edge of the cube, into the surface without turning any
    /// inside out. Throws InputError, with the place and the remedy, where that does not succeed.
    explicit SphereInterior(const SphereMap& map, int cells = 10);

    /// The point (m) for a direction and a fraction from 0 (one point for all directions) to 1 (the surface).
    Vec3 point(const Vec3& direction, double fraction) const;

  private:
    const SphereMap& m_map;
    BrickSurface m_brick;
    std::vector<Vec3>
        m_nodes;  ///< [level * columns + column], level 0 a fraction 1 / levels out; then the centre
};

}  // namespace windfall::geometry
