#pragma once
// A closed surface of triangles taken as the smooth one that it stands for: facets of an artist's mesh must
// not show as wrinkles.
#include <limits>
#include <vector>

#include "geometry/triangle_surface.h"
#include "geometry/triangle_tree.h"

namespace windfall::geometry {

/// A point of a surface and the smooth unit normal there.
struct SurfaceSpot {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    SurfacePlace place;
};

/// Curved between its vertices by Phong tessellation (Boubekeur and Alexa 2008) with the share 1/2, which
/// gives arcs back to second order; flat towards vertices on creases, where faces turn by more than
/// `kCrease`. Owns copies of what it is built from. Immutable; safe to read from several threads.
class CurvedSurface {
  public:
    static constexpr double kCrease = 0.6;  ///< radians between a face and the normal at its vertex

    explicit CurvedSurface(TriangleSurface surface);

    const TriangleSurface& triangles() const { return m_surface; }
    const TriangleTree& tree() const { return m_tree; }
    double area() const { return m_area; }

    SurfaceSpot at(const SurfacePlace& place) const;
    /// The spot of the nearest point among triangles that face along `facing` (zero: any) and lie within
    /// `within`; place.triangle is -1 when there is none.
    SurfaceSpot nearest(const Vec3& point, const Vec3& facing = Vec3::Zero(),
                        double within = std::numeric_limits<double>::infinity()) const;

  private:
    TriangleSurface m_surface;
    std::vector<Vec3> m_normals;
    std::vector<double> m_share;  ///< per vertex: of the way to the tangent planes
    TriangleTree m_tree;
    double m_area = 0;
};

}  // namespace windfall::geometry
