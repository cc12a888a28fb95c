#include "decay/body_neighbours.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "decay/body_measure.h"

namespace windfall::decay {

namespace {

using Eigen::Vector3f;

/// Ericson 2005, Real-Time Collision Detection, section 5.1.5.
Vector3f nearest_on_triangle(const Vector3f& p, const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    const Vector3f ab = b - a, ac = c - a, ap = p - a;
    const float d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vector3f bp = p - b;
    const float d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
    const Vector3f cp = p - c;
    const float d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const float sum = 1 / (va + vb + vc);
    return a + ab * (vb * sum) + ac * (vc * sum);
}

}  // namespace

NearSurface::NearSurface(const std::vector<Vector3f>& points, const std::vector<geometry::Face>& faces,
                         float reach_m)
    : m_points(points),
      m_normals(surface_normals(points, faces)),
      m_low(Vector3f::Constant(std::numeric_limits<float>::infinity())),
      m_high(-m_low),
      m_reach(reach_m) {
    for (std::size_t v = 0; v < points.size(); ++v) {
        m_low = m_low.cwiseMin(points[v]);
        m_high = m_high.cwiseMax(points[v]);
        m_cells[cell_of((points[v] / m_reach).array().floor().cast<int>())].push_back(
            static_cast<std::int32_t>(v));
    }
    m_low.array() -= m_reach;
    m_high.array() += m_reach;
}

std::uint64_t NearSurface::cell_of(const Eigen::Vector3i& cell) const {
    const auto part = [](int c) { return static_cast<std::uint64_t>(c + (1 << 20)) & 0x1FFFFFU; };
    return part(cell.x()) | part(cell.y()) << 21U | part(cell.z()) << 42U;
}

std::int32_t NearSurface::nearest(const Vector3f& point) const {
    std::int32_t best = -1;
    float best_sq = std::numeric_limits<float>::infinity();
    for_near(point, [&](std::int32_t v) {
        const float distance_sq = (m_points[v] - point).squaredNorm();
        if (distance_sq < best_sq || (distance_sq == best_sq && v < best)) {
            best_sq = distance_sq;
            best = v;
        }
    });
    return best;
}

ContactPlane NearSurface::half_way(const Vector3f& point) const {
    const std::int32_t v = nearest(point);
    if (v < 0) return {};
    const Vector3f& normal = m_normals[v];
    const float gap = normal.dot(point - m_points[v]);
    return {normal, normal.dot(point) - gap / 2};
}

MeasuredSurface::MeasuredSurface(const std::vector<Vector3f>& points,
                                 const std::vector<geometry::Face>& faces, float reach_m)
    : m_near(points, faces, reach_m), m_triangles(points.size()) {
    for (const auto& f : faces) {
        const std::array<std::int32_t, 3> first{f[0], f[1], f[2]};
        for (const auto v : first) m_triangles[v].push_back(first);
        if (geometry::corner_count(f) == 3) continue;
        const std::array<std::int32_t, 3> second{f[0], f[2], f[3]};
        for (const auto v : second) m_triangles[v].push_back(second);
    }
}

float MeasuredSurface::signed_distance_m(const Vector3f& point) const {
    const auto& x = m_near.points();
    const auto& n = m_near.normals();
    float best_sq = std::numeric_limits<float>::infinity();
    float sign = 1;
    m_near.for_near(point, [&](std::int32_t v) {
        for (const auto& t : m_triangles[v]) {
            const Vector3f on = nearest_on_triangle(point, x[t[0]], x[t[1]], x[t[2]]);
            const float distance_sq = (point - on).squaredNorm();
            if (distance_sq >= best_sq) continue;
            best_sq = distance_sq;
            // At an edge or corner the face's own normal may mislead: the mean of the corners' decides.
            const Vector3f normal = n[t[0]] + n[t[1]] + n[t[2]];
            sign = normal.dot(point - on) < 0 ? -1.0F : 1.0F;
        }
    });
    return sign * std::sqrt(best_sq);
}

}  // namespace windfall::decay
