#include "decay/body_measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "core/parallel.h"

namespace windfall::decay {

namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::int32_t, 3>;
using Edge = std::array<std::int32_t, 2>;

std::vector<Triangle> triangles_of(const std::vector<geometry::Face>& faces) {
    std::vector<Triangle> triangles;
    triangles.reserve(2 * faces.size());
    for (const auto& f : faces) {
        triangles.push_back({f[0], f[1], f[2]});
        if (geometry::corner_count(f) == 4) triangles.push_back({f[0], f[2], f[3]});
    }
    return triangles;
}

std::vector<Edge> edges_of_triangles(const std::vector<Triangle>& triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const auto& t : triangles)
        for (int k = 0; k < 3; ++k)
            edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Whether the segment pq passes through the triangle: signs of the volumes spanned with its corners.
bool pierces(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d normal = (b - a).cross(c - a);
    if ((p - a).dot(normal) * (q - a).dot(normal) >= 0) return false;
    const Vector3d d = q - p;
    const double u = d.dot((a - p).cross(b - p));
    const double v = d.dot((b - p).cross(c - p));
    const double w = d.dot((c - p).cross(a - p));
    return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

/// Triangles by the cells of a regular grid that their bounding boxes touch.
class TriangleGrid {
  public:
    TriangleGrid(const SurfacePoints& points, const std::vector<Triangle>& triangles, float cell)
        : m_inverse_cell(1 / cell) {
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const auto& [a, b, c] = triangles[t];
            for_cells(points[a].cwiseMin(points[b]).cwiseMin(points[c]),
                      points[a].cwiseMax(points[b]).cwiseMax(points[c]),
                      [&](std::uint64_t key) { m_cells[key].push_back(static_cast<std::int32_t>(t)); });
        }
    }

    template <class Visit>
    void near_box(const Eigen::Vector3f& low, const Eigen::Vector3f& high, const Visit& visit) const {
        for_cells(low, high, [&](std::uint64_t key) {
            const auto found = m_cells.find(key);
            if (found == m_cells.end()) return;
            for (const auto t : found->second) visit(t);
        });
    }

  private:
    template <class Visit>
    void for_cells(const Eigen::Vector3f& low, const Eigen::Vector3f& high, const Visit& visit) const {
        const Eigen::Vector3i a = (low * m_inverse_cell).array().floor().cast<int>();
        const Eigen::Vector3i b = (high * m_inverse_cell).array().floor().cast<int>();
        for (int k = a.z(); k <= b.z(); ++k)
            for (int j = a.y(); j <= b.y(); ++j)
                for (int i = a.x(); i <= b.x(); ++i) visit(key_of(i, j, k));
    }
    static std::uint64_t key_of(int i, int j, int k) {
        const auto part = [](int c) { return static_cast<std::uint64_t>(c + (1 << 20)) & 0x1FFFFFU; };
        return part(i) | part(j) << 21U | part(k) << 42U;
    }

    float m_inverse_cell;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> m_cells;
};

}  // namespace

double surface_volume_m3(const SurfacePoints& points, const std::vector<geometry::Face>& faces) {
    double six_volumes = 0;
    for (const auto& t : triangles_of(faces))
        six_volumes +=
            points[t[0]].cast<double>().dot(points[t[1]].cast<double>().cross(points[t[2]].cast<double>()));
    return six_volumes / 6;
}

double surface_area_m2(const SurfacePoints& points, const std::vector<geometry::Face>& faces) {
    double twice = 0;
    for (const auto& t : triangles_of(faces))
        twice += (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
    return twice / 2;
}

SurfacePoints surface_normals(const SurfacePoints& points, const std::vector<geometry::Face>& faces) {
    SurfacePoints normals(points.size(), Eigen::Vector3f::Zero());
    for (const auto& f : faces) {
        const int last = geometry::corner_count(f) - 1;
        const Eigen::Vector3f n = last == 3
                                      ? (points[f[2]] - points[f[0]]).cross(points[f[3]] - points[f[1]])
                                      : (points[f[1]] - points[f[0]]).cross(points[f[2]] - points[f[0]]);
        for (int k = 0; k <= last; ++k) normals[f[k]] += n;
    }
    for (auto& n : normals) {
        const float length = n.norm();
        if (length > 0) n /= length;
    }
    return normals;
}

int crossing_edges(const SurfacePoints& points, const std::vector<geometry::Face>& faces) {
    const auto triangles = triangles_of(faces);
    const auto edges = edges_of_triangles(triangles);
    float longest = 0;
    double mean = 0;
    for (const auto& [p, q] : edges) {
        const float length = (points[p] - points[q]).norm();
        longest = std::max(longest, length);
        mean += length;
    }
    mean /= static_cast<double>(edges.size());
    const TriangleGrid grid(points, triangles, std::max(static_cast<float>(2 * mean), longest / 4));
    const auto at = [&points](std::int32_t v) -> Vector3d { return points[v].cast<double>(); };
    return static_cast<int>(parallel_sum(edges.size(), 1024, [&](std::size_t begin, std::size_t end) {
        double count = 0;
        for (std::size_t e = begin; e < end; ++e) {
            const std::int32_t p = edges[e][0], q = edges[e][1];  // clang 14 captures no bindings
            bool crossed = false;
            grid.near_box(points[p].cwiseMin(points[q]), points[p].cwiseMax(points[q]), [&](std::int32_t t) {
                if (crossed) return;
                const auto& [a, b, c] = triangles[t];
                if (p == a || p == b || p == c || q == a || q == b || q == c) return;
                crossed = pierces(at(p), at(q), at(a), at(b), at(c));
            });
            count += crossed ? 1 : 0;
        }
        return count;
    }));
}

}  // namespace windfall::decay
