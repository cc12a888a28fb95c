#include "geometry/sphere_map_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace windfall::geometry {

namespace {

constexpr int kSides = 6;
constexpr int kFewestCells = 4, kMostCells = 512;

/// The part of a polygon (a cone through it) where plane . x >= 0.
void clip(std::vector<Vec3>& polygon, const Vec3& plane) {
    std::vector<Vec3> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& a = polygon[i];
        const Vec3& b = polygon[(i + 1) % polygon.size()];
        const double height_a = plane.dot(a), height_b = plane.dot(b);
        if (height_a >= 0) inside.push_back(a);
        if ((height_a >= 0) != (height_b >= 0))
            inside.emplace_back((height_a * b - height_b * a) / (height_a - height_b));
    }
    polygon = std::move(inside);
}

/// Cells [low, high] along both axes of a side.
struct Range {
    int low[2], high[2];
};

/// The cells of a side that a cone may reach into; low > high where it does not reach the side at all.
Range range_on_side(const std::array<Vec3, 3>& corners, int side, int size) {
    // A little wider than the side, so that rounding leaves no gap along the cube's edges.
    constexpr double kWider = 1 + 1e-6;
    const int axis = side / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double sign = side % 2 == 1 ? 1 : -1;
    if (std::all_of(corners.begin(), corners.end(), [&](const Vec3& p) { return sign * p[axis] <= 0; }))
        return {{1, 1}, {0, 0}};
    std::vector<Vec3> polygon(corners.begin(), corners.end());
    for (const int across : {a, b})
        for (const double towards : {1.0, -1.0}) {
            Vec3 plane = Vec3::Zero();
            plane[axis] = kWider * sign;
            plane[across] = towards;
            if (!polygon.empty()) clip(polygon, plane);
        }
    if (polygon.empty()) return {{1, 1}, {0, 0}};
    Range range{{size, size}, {-1, -1}};
    for (const Vec3& p : polygon) {
        // Only a cone around the cube's opposite side is behind: clipping has left nothing of it but
        // rounding.
        const double depth = std::max(sign * p[axis], 1e-12);
        for (int k = 0; k < 2; ++k) {
            const double along = (0.5 + 0.5 * p[k == 0 ? a : b] / depth) * size;
            range.low[k] = std::min(range.low[k], std::clamp(static_cast<int>(along - 1e-6), 0, size - 1));
            range.high[k] = std::max(range.high[k], std::clamp(static_cast<int>(along + 1e-6), 0, size - 1));
        }
    }
    return range;
}

}  // namespace

SphereGrid::Cell SphereGrid::cell_of(const Vec3& direction) const {
    int axis = 0;
    const double largest = direction.cwiseAbs().maxCoeff(&axis);
    const auto along = [&](int i) {
        return std::clamp(static_cast<int>((0.5 + 0.5 * direction[i] / largest) * m_size), 0, m_size - 1);
    };
    return {2 * axis + (direction[axis] > 0 ? 1 : 0), along((axis + 1) % 3), along((axis + 2) % 3)};
}

SphereGrid::SphereGrid(const std::vector<Vec3>& directions, const std::vector<Triangle>& triangles)
    : m_size(std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles.size()) / 3)), kFewestCells,
                        kMostCells)) {
    m_corners.reserve(triangles.size());
    for (const Triangle& t : triangles)
        m_corners.push_back({directions[t[0]], directions[t[1]], directions[t[2]]});
    struct Entry {
        std::uint32_t cell;
        std::int32_t triangle;
    };
    std::vector<Entry> entries;
    for (std::size_t t = 0; t < m_corners.size(); ++t) {
        for (int side = 0; side < kSides; ++side) {
            const Range range = range_on_side(m_corners[t], side, m_size);
            for (int row = range.low[1]; row <= range.high[1]; ++row)
                for (int column = range.low[0]; column <= range.high[0]; ++column)
                    entries.push_back({static_cast<std::uint32_t>(index_of({side, column, row})),
                                       static_cast<std::int32_t>(t)});
        }
    }
    m_starts.assign(static_cast<std::size_t>(kSides) * m_size * m_size + 1, 0);
    for (const Entry& entry : entries) ++m_starts[entry.cell + 1];
    for (std::size_t i = 1; i < m_starts.size(); ++i) m_starts[i] += m_starts[i - 1];
    std::vector<std::uint32_t> next(m_starts.begin(), m_starts.end() - 1);
    m_triangles.resize(entries.size());
    for (const Entry& entry : entries) m_triangles[next[entry.cell]++] = entry.triangle;
}

SurfacePlace SphereGrid::place(const Vec3& direction) const {
    const std::size_t cell = index_of(cell_of(direction));
    SurfacePlace best;
    double best_least = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = m_starts[cell]; i < m_starts[cell + 1]; ++i) {
        const auto& [a, b, c] = m_corners[m_triangles[i]];
        const Vec3 weights(direction.dot(b.cross(c)), direction.dot(c.cross(a)), direction.dot(a.cross(b)));
        const double sum = weights.sum();
        if (!(sum > 0)) continue;
        const double least = weights.minCoeff() / sum;
        if (least <= best_least) continue;
        best_least = least;
        best = {m_triangles[i], weights / sum};
        if (least >= 0) return best;
    }
    // Between two triangles by rounding: the nearer one, at its rim.
    best.weights = best.weights.cwiseMax(0.0);
    best.weights /= best.weights.sum();
    return best;
}

}  // namespace windfall::geometry
