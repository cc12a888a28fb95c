#include "geometry/curved_surface.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace windfall::geometry {

CurvedSurface::CurvedSurface(TriangleSurface surface)
    : m_surface(std::move(surface)),
      m_normals(vertex_normals(m_surface)),
      m_share(m_surface.positions.size(), 0.5),
      m_tree(m_surface.positions, m_surface.triangles) {
    for (const Triangle& t : m_surface.triangles) {
        const Vec3& a = m_surface.positions[t[0]];
        const Vec3 twice = (m_surface.positions[t[1]] - a).cross(m_surface.positions[t[2]] - a);
        m_area += twice.norm() / 2;
        for (const std::int32_t v : t)
            if (m_normals[v].dot(twice) < std::cos(kCrease) * twice.norm()) m_share[v] = 0;
    }
}

SurfaceSpot CurvedSurface::at(const SurfacePlace& place) const {
    const Triangle& t = m_surface.triangles[place.triangle];
    const Vec3 flat = at_place(m_surface.positions, m_surface.triangles, place);
    SurfaceSpot spot{flat, Vec3::Zero(), place};
    for (int k = 0; k < 3; ++k) {
        const Vec3& n = m_normals[t[k]];
        spot.point -= m_share[t[k]] * place.weights[k] * n.dot(flat - m_surface.positions[t[k]]) * n;
        spot.normal += place.weights[k] * n;
    }
    spot.normal.normalize();
    return spot;
}

SurfaceSpot CurvedSurface::nearest(const Vec3& point, const Vec3& facing, double within) const {
    const TriangleTree::Nearest found = m_tree.nearest(point, facing, within);
    if (found.place.triangle < 0) return {point, Vec3::Zero(), found.place};
    return at(found.place);
}

}  // namespace windfall::geometry
