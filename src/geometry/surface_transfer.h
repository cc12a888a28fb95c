#pragma once
// An artist's vertices ride on a body's skin: order, faces and texture coordinates of the artist's mesh stay
// as they are, only positions move.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/brick_surface.h"

namespace windfall::geometry {

/// Every vertex keeps its place (u, v) in the nearest quadrilateral of the skin and its offset from the skin
/// as seen from there. The skin counts as curved between its vertices (Phong tessellation, Boubekeur and
/// Alexa 2008), or its facets would show on the artist's finer mesh. Immutable; safe to use from several
/// threads.
class SurfaceTransfer {
  public:
    /// `vertices` and `normals`: the artist's, at rest; `skin`: the skin at rest, close to them. Throws
    /// InputError when sizes do not fit or a vertex is further than the skin's mean edge from the skin.
    SurfaceTransfer(const std::vector<Vec3>& vertices, const std::vector<Vec3>& normals,
                    const std::vector<Eigen::Vector3f>& skin, std::vector<Quad> quads);

    /// Positions of the artist's vertices for a moved skin.
    std::vector<Eigen::Vector3f> moved(const std::vector<Eigen::Vector3f>& skin) const;

    /// Values on the skin's vertices, one each, at the places of the artist's: bilinear.
    std::vector<float> carried(const std::vector<float>& values) const;

    /// Distance (m) of the vertex that lies furthest from the skin at rest.
    double largest_offset_m() const { return m_largest_offset_m; }

  private:
    struct Bond {
        std::int32_t quad = 0;
        float u = 0, v = 0;
        Eigen::Vector3f offset;  ///< in the frame of the place, over the root of the patch's area
    };
    std::size_t m_skin_vertices;
    std::vector<Quad> m_quads;
    std::vector<Bond> m_bonds;
    double m_largest_offset_m = 0;
};

}  // namespace windfall::geometry
