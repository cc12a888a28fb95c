#include "geometry/sphere_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/sphere_map_areas.h"
#include "geometry/sphere_map_flow.h"

namespace windfall::geometry {

namespace {

std::vector<Vec3> even_directions(const TriangleSurface& surface) {
    std::vector<Vec3> directions = flow_to_sphere(surface);
    spread_areas(surface, directions);
    return directions;
}

/// Solid angle of a spherical triangle (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace

SphereMap::SphereMap(const SurfaceMesh& mesh)
    : m_surface(welded_triangles(mesh)),
      m_directions(even_directions(m_surface)),
      m_normals(vertex_normals(m_surface)),
      m_grid(m_directions, m_surface.triangles) {}

std::array<double, 2> SphereMap::area_ratios() const {
    const auto area = [&](const Triangle& t) {
        const auto& p = m_surface.positions;
        return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
    };
    double total = 0;
    for (const Triangle& t : m_surface.triangles) total += area(t);
    std::array<double, 2> ratios{std::numeric_limits<double>::infinity(), 0};
    for (const Triangle& t : m_surface.triangles) {
        const double share =
            solid_angle(m_directions[t[0]], m_directions[t[1]], m_directions[t[2]]) / (4 * std::acos(-1.0));
        ratios[0] = std::min(ratios[0], share * total / area(t));
        ratios[1] = std::max(ratios[1], share * total / area(t));
    }
    return ratios;
}

}  // namespace windfall::geometry
