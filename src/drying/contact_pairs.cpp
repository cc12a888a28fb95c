#include "drying/contact_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/parallel.h"

namespace windfall::drying {

using geometry::Vec3;

namespace {

struct ContactBox {
    Vec3 low, high;
    void widen(const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    double distance_sq(const ContactBox& other) const {
        return (low - other.high).cwiseMax(other.low - high).cwiseMax(0.0).squaredNorm();
    }
};

/// Points sorted into cubic cells.
class PointGrid {
  public:
    PointGrid(const std::vector<Vec3>& points, double cell) {
        constexpr int kMostCells = 128;  // along an axis
        ContactBox box{points.front(), points.front()};
        for (const Vec3& p : points) box.widen(p);
        const double longest = (box.high - box.low).maxCoeff();
        m_low = box.low;
        m_cell = std::max(cell, longest / (kMostCells - 1));
        for (int i = 0; i < 3; ++i) m_count[i] = 1 + static_cast<int>((box.high - box.low)[i] / m_cell);
        m_begin.assign(static_cast<std::size_t>(m_count[0]) * m_count[1] * m_count[2] + 1, 0);
        std::vector<std::size_t> cell_of(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::array<int, 3> at = clamped(points[i]);
            cell_of[i] = index(at[0], at[1], at[2]);
            ++m_begin[cell_of[i] + 1];
        }
        for (std::size_t c = 1; c < m_begin.size(); ++c) m_begin[c] += m_begin[c - 1];
        m_points.resize(points.size());
        std::vector<std::int32_t> next(m_begin.begin(), m_begin.end() - 1);
        for (std::size_t i = 0; i < points.size(); ++i)
            m_points[next[cell_of[i]]++] = static_cast<std::int32_t>(i);
    }

    /// Calls visit(i) for all points in the cells that a box meets.
    template <class Visit>
    void for_each_in(const Vec3& low, const Vec3& high, const Visit& visit) const {
        const std::array<int, 3> from = clamped(low), to = clamped(high);
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y) {
                // Cells along x follow each other.
                const std::int32_t end = m_begin[index(to[0], y, z) + 1];
                for (std::int32_t i = m_begin[index(from[0], y, z)]; i < end; ++i) visit(m_points[i]);
            }
    }

  private:
    std::array<int, 3> clamped(const Vec3& p) const {
        std::array<int, 3> result{};
        for (int i = 0; i < 3; ++i)
            result[i] = static_cast<int>(
                std::clamp((p[i] - m_low[i]) / m_cell, 0.0, static_cast<double>(m_count[i] - 1)));
        return result;
    }
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * m_count[1] + y) * m_count[0] + x;
    }

    Vec3 m_low;
    double m_cell = 1;
    std::array<int, 3> m_count{};
    std::vector<std::int32_t> m_begin, m_points;
};

/// Runs body(i, found) for i in [0, count) and joins what it finds in the order of i.
template <class Body>
void collect_pairs(std::size_t count, std::vector<ContactPair>& pairs, const Body& body) {
    constexpr std::size_t kBlock = 512;
    std::vector<std::vector<ContactPair>> found((count + kBlock - 1) / kBlock);
    parallel_blocks(count, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i, found[begin / kBlock]);
    });
    for (const auto& block : found) pairs.insert(pairs.end(), block.begin(), block.end());
}

}  // namespace

ContactSurface::ContactSurface(std::vector<Vec3> positions,
                               const std::vector<std::array<std::int32_t, 4>>& quads)
    : fresh(std::move(positions)), vertex_areas(fresh.size(), 0) {
    std::map<std::array<std::int32_t, 2>, double> area_of;
    for (const auto& [a, b, c, d] : quads)
        for (const std::array<std::int32_t, 3>& t : {std::array{a, b, c}, std::array{a, c, d}}) {
            triangles.push_back(t);
            const double third = (fresh[t[1]] - fresh[t[0]]).cross(fresh[t[2]] - fresh[t[0]]).norm() / 6;
            for (std::size_t i = 0; i < 3; ++i) {
                vertex_areas[t[i]] += third;
                const std::int32_t next = t[(i + 1) % 3];
                area_of[{std::min(t[i], next), std::max(t[i], next)}] += third;
            }
        }
    for (const auto& [edge, area] : area_of) {
        edges.push_back(edge);
        edge_areas.push_back(area);
    }
}

double ContactSurface::smallest_height() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) {
        const double twice = (fresh[t[1]] - fresh[t[0]]).cross(fresh[t[2]] - fresh[t[0]]).norm();
        for (std::size_t i = 0; i < 3; ++i)
            smallest = std::min(smallest, twice / (fresh[t[(i + 1) % 3]] - fresh[t[i]]).norm());
    }
    return smallest;
}

std::vector<ContactPair> find_contact_pairs(const ContactSurface& surface, const std::vector<Vec3>& positions,
                                            double reach, const std::vector<double>& allowances) {
    const double largest_allowance = *std::max_element(allowances.begin(), allowances.end());
    const std::vector<Vec3>& x = positions;
    std::vector<Vec3> middles;
    double longest = 0;
    double sum = 0;
    for (const auto& [a, b] : surface.edges) {
        const double length = (x[a] - x[b]).norm();
        middles.emplace_back(0.5 * (x[a] + x[b]));
        longest = std::max(longest, length);
        sum += length;
    }
    const double mean = sum / static_cast<double>(surface.edges.size());
    std::vector<ContactPair> pairs;

    const PointGrid vertices(x, mean);
    collect_pairs(surface.triangles.size(), pairs, [&](std::size_t i, std::vector<ContactPair>& found) {
        const std::int32_t a = surface.triangles[i][0], b = surface.triangles[i][1],
                           c = surface.triangles[i][2];
        const double own = reach + std::max({allowances[a], allowances[b], allowances[c]});
        ContactBox box{x[a], x[a]};
        box.widen(x[b]);
        box.widen(x[c]);
        const Vec3 wide = Vec3::Constant(own + largest_allowance);
        const std::size_t first = found.size();
        vertices.for_each_in(box.low - wide, box.high + wide, [&](std::int32_t v) {
            if (v == a || v == b || v == c) return;
            const double near = own + allowances[v];
            if (box.distance_sq({x[v], x[v]}) > near * near) return;
            if (contact_gap(ContactKind::VertexTriangle, {x[v], x[a], x[b], x[c]}).distance > near) return;
            found.push_back({ContactKind::VertexTriangle, {v, a, b, c}, surface.vertex_areas[v]});
        });
        std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
                  [](const ContactPair& p, const ContactPair& q) { return p.vertices < q.vertices; });
    });

    const PointGrid grid(middles, mean);
    collect_pairs(surface.edges.size(), pairs, [&](std::size_t i, std::vector<ContactPair>& found) {
        const std::int32_t a = surface.edges[i][0], b = surface.edges[i][1];
        const double own = reach + std::max(allowances[a], allowances[b]);
        ContactBox box{x[a], x[a]};
        box.widen(x[b]);
        const Vec3 wide = Vec3::Constant(own + largest_allowance + longest / 2);
        const std::size_t first = found.size();
        grid.for_each_in(box.low - wide, box.high + wide, [&](std::int32_t j) {
            if (static_cast<std::size_t>(j) <= i) return;
            const auto [c, d] = surface.edges[j];
            if (a == c || a == d || b == c || b == d) return;
            const double near = own + std::max(allowances[c], allowances[d]);
            ContactBox other{x[c], x[c]};
            other.widen(x[d]);
            if (box.distance_sq(other) > near * near) return;
            if (contact_gap(ContactKind::EdgeEdge, {x[a], x[b], x[c], x[d]}).distance > near) return;
            const double area = (surface.edge_areas[i] + surface.edge_areas[j]) / 2;
            found.push_back({ContactKind::EdgeEdge, {a, b, c, d}, area});
        });
        std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
                  [](const ContactPair& p, const ContactPair& q) { return p.vertices < q.vertices; });
    });
    return pairs;
}

}  // namespace windfall::drying
