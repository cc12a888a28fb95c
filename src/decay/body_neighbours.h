#pragma once
// How near one fruit's surface is to another's.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "decay/body_ground.h"
#include "geometry/surface_mesh.h"

namespace windfall::decay {

/// The vertices of a closed surface that are asked for the nearest one. Keeps a copy.
class NearSurface {
  public:
    /// `reach_m`: farther points get no answer.
    NearSurface(const std::vector<Eigen::Vector3f>& points, const std::vector<geometry::Face>& faces,
                float reach_m);

    /// Nearest vertex; -1 if none is within reach.
    std::int32_t nearest(const Eigen::Vector3f& point) const;

    /// The plane half way between a point and the surface: both fruit see the same one, from their two sides.
    /// The default plane when the surface is out of reach.
    ContactPlane half_way(const Eigen::Vector3f& point) const;

    const std::vector<Eigen::Vector3f>& points() const { return m_points; }
    const std::vector<Eigen::Vector3f>& normals() const { return m_normals; }

    /// Calls visit(vertex) for all within reach.
    template <class Visit>
    void for_near(const Eigen::Vector3f& point, const Visit& visit) const;

  private:
    std::uint64_t cell_of(const Eigen::Vector3i& cell) const;

    std::vector<Eigen::Vector3f> m_points, m_normals;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> m_cells;
    Eigen::Vector3f m_low, m_high;  ///< of the points, with the reach around
    float m_reach;
};

/// The same with its faces, for exact distances.
class MeasuredSurface {
  public:
    MeasuredSurface(const std::vector<Eigen::Vector3f>& points, const std::vector<geometry::Face>& faces,
                    float reach_m);

    /// Distance to the surface (m), negative inside; +infinity out of reach.
    float signed_distance_m(const Eigen::Vector3f& point) const;

  private:
    NearSurface m_near;
    std::vector<std::vector<std::array<std::int32_t, 3>>> m_triangles;  ///< around each vertex
};

template <class Visit>
void NearSurface::for_near(const Eigen::Vector3f& point, const Visit& visit) const {
    if ((point.array() < m_low.array()).any() || (point.array() > m_high.array()).any()) return;
    const Eigen::Vector3i cell = (point / m_reach).array().floor().cast<int>();
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const auto found = m_cells.find(cell_of(cell + Eigen::Vector3i(i, j, k)));
                if (found == m_cells.end()) continue;
                for (const auto v : found->second)
                    if ((m_points[v] - point).squaredNorm() <= m_reach * m_reach) visit(v);
            }
}

}  // namespace windfall::decay
