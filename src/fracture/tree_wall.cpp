#include "fracture/tree_wall.h"
#include "core/angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::fracture {
namespace {

using geometry::kNoVertex;
using geometry::Vec3;

// Between the last row and the broken edge, and between the cut and the first row, in radii.
constexpr double kEdgeGap = 0.015, kFirstRow = 0.05;

double turned_to(double angle, double near) { return near + std::remainder(angle - near, kTwoPi<double>); }

class BarkMaker {
  public:
    BarkMaker(const WallPlan& plan, const BranchAxis& axis, const TreeRays& rays)
        : m_plan(plan), m_axis(axis), m_rays(rays), m_down(plan.is_piece ? 1.0 : -1.0) {}

    BranchBark make() {
        add_loop();
        add_edge();
        add_rows();
        join_loop_and_first_row();
        for (std::size_t row = 0; row + 1 < m_rows; ++row)
            for (std::size_t s = 0; s < m_plan.nodes.size(); ++s)
                add_face({at(s, row), at(s + 1, row), at(s + 1, row + 1), at(s, row + 1)});
        join_last_row_and_edge();
        return std::move(m_bark);
    }

  private:
    std::int32_t add_hit(double angle, double height) {
        const AxisFrame frame = m_axis.at(height);
        const SurfacePlace place = m_rays.hit(frame.centre, frame.direction(angle));
        m_bark.vertices.push_back({place.position, angle, height, {place}});
        return static_cast<std::int32_t>(m_bark.vertices.size()) - 1;
    }

    void add_loop() {
        const AxisFrame frame = m_axis.at(m_plan.loop_height);
        const auto& points = m_plan.loop.points;
        double angle = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const SectionPoint& p = points[i];
            const Vec3 out = p.position - frame.centre;
            angle = turned_to(std::atan2(out.dot(frame.third()), out.dot(frame.across)), angle);
            const std::int32_t before = points[i > 0 ? i - 1 : points.size() - 1].triangle;
            m_bark.vertices.push_back(
                {p.position, angle, m_plan.loop_height, {on_edge(p, before), on_edge(p, p.triangle)}});
        }
    }

    SurfacePlace on_edge(const SectionPoint& p, std::int32_t triangle) const {
        SurfacePlace place{triangle, Vec3::Zero(), p.position};
        const auto& v = m_rays.surface().triangles[static_cast<std::size_t>(triangle)].vertices;
        for (int k = 0; k < 3; ++k) {
            if (v[static_cast<std::size_t>(k)] == p.low) place.weights[k] = 1 - p.share;
            if (v[static_cast<std::size_t>(k)] == p.high) place.weights[k] = p.share;
        }
        return place;
    }

    const Vector3f& broken(std::int32_t v) const { return m_plan.surface[static_cast<std::size_t>(v)]; }
    double height_of(std::int32_t v) const {
        return m_plan.unit * (static_cast<double>(broken(v).z()) - m_plan.middle);
    }

    void add_edge() {
        double angle = 0;
        for (const EdgeNode& node : m_plan.nodes) {
            m_first_of_node.push_back(static_cast<std::int32_t>(m_bark.vertices.size()));
            const Vector3f& p = broken(node.before);
            angle = turned_to(std::atan2(p.y(), p.x()), angle);
            add_hit(angle, height_of(node.before));
            m_bark.edge.push_back(node.before);
            if (node.behind == node.before) continue;
            const Vector3f& q = broken(node.behind);
            add_hit(turned_to(std::atan2(q.y(), q.x()), angle), height_of(node.behind));
            m_bark.edge.push_back(node.behind);
        }
    }
    std::int32_t before(std::size_t s) const { return m_first_of_node[s % m_plan.nodes.size()]; }
    std::int32_t behind(std::size_t s) const {
        const EdgeNode& node = m_plan.nodes[s % m_plan.nodes.size()];
        return before(s) + (node.before == node.behind ? 0 : 1);
    }

    /// Rows from just beyond the cut, where they are level, to just short of the edge, whose shape they take.
    void add_rows() {
        const double first = m_plan.loop_height - m_down * kFirstRow * m_plan.unit;
        std::vector<double> last;
        double longest = 0;
        for (const EdgeNode& node : m_plan.nodes) {
            const double a = height_of(node.before), b = height_of(node.behind);
            last.push_back((m_down < 0 ? std::min(a, b) : std::max(a, b)) + m_down * kEdgeGap * m_plan.unit);
            longest = std::max(longest, std::abs(last.back() - first));
        }
        const double sector = kTwoPi<double> * m_plan.unit / static_cast<double>(m_plan.nodes.size());
        m_rows = static_cast<std::size_t>(
            std::clamp(std::ceil(longest / (2 * sector)), 3.0,
                       static_cast<double>(std::max<std::size_t>(m_plan.most_rows, 3))));
        m_first_row = static_cast<std::int32_t>(m_bark.vertices.size());
        for (std::size_t s = 0; s < m_plan.nodes.size(); ++s) {
            const auto& vertices = m_bark.vertices;
            const double angle = 0.5 * (vertices[static_cast<std::size_t>(before(s))].angle +
                                        vertices[static_cast<std::size_t>(behind(s))].angle);
            for (std::size_t row = 0; row < m_rows; ++row) {
                const double left = 1 - static_cast<double>(row) / static_cast<double>(m_rows - 1);
                add_hit(angle, last[s] + (first - last[s]) * left * left);
            }
        }
    }
    std::int32_t at(std::size_t s, std::size_t row) const {
        return m_first_row + static_cast<std::int32_t>((s % m_plan.nodes.size()) * m_rows + row);
    }

    void join_loop_and_first_row() {
        const std::size_t loop = m_plan.loop.points.size(), nodes = m_plan.nodes.size();
        const auto angle = [&](std::int32_t v) { return m_bark.vertices[static_cast<std::size_t>(v)].angle; };
        // Start at the loop's point that follows the first column.
        std::size_t start = 0;
        double least = kTwoPi<double>;
        for (std::size_t i = 0; i < loop; ++i) {
            const double ahead =
                turned_to(angle(static_cast<std::int32_t>(i)) - angle(at(0, 0)), std::numbers::pi);
            if (ahead >= least) continue;
            least = ahead;
            start = i;
        }
        const auto loop_vertex = [&](std::size_t i) { return static_cast<std::int32_t>((start + i) % loop); };
        // Angles from the first column on; those of both rings rise from vertex to vertex.
        const auto loop_angle = [&](std::size_t i) {
            const double turns = start + i >= loop ? kTwoPi<double> : 0;
            return least + angle(loop_vertex(i)) - angle(static_cast<std::int32_t>(start)) + turns;
        };
        const auto node_angle = [&](std::size_t s) {
            return angle(at(s, 0)) - angle(at(0, 0)) + (s == nodes ? kTwoPi<double> : 0.0);
        };
        std::size_t i = 0, s = 0;
        while (i < loop || s < nodes) {
            const bool next_is_node = i == loop || (s < nodes && node_angle(s + 1) <= loop_angle(i + 1));
            if (next_is_node) {
                add_face({loop_vertex(i), at(s + 1, 0), at(s, 0), kNoVertex});
                ++s;
            } else {
                add_face({loop_vertex(i), loop_vertex(i + 1), at(s, 0), kNoVertex});
                ++i;
            }
        }
    }

    void join_last_row_and_edge() {
        const std::size_t last = m_rows - 1;
        for (std::size_t s = 0; s < m_plan.nodes.size(); ++s) {
            add_face({at(s, last), at(s + 1, last), before(s + 1), behind(s)});
            if (before(s) != behind(s)) add_face({at(s, last), behind(s), before(s), kNoVertex});
        }
    }

    /// Corners as they are on the stub; the piece's wall is its mirror image.
    void add_face(geometry::Face corners) {
        const bool is_triangle = corners[3] == kNoVertex;
        double angle = 0, height = 0;
        const double first = m_bark.vertices[static_cast<std::size_t>(corners[0])].angle;
        const int count = is_triangle ? 3 : 4;
        for (int k = 0; k < count; ++k) {
            const BarkVertex& v =
                m_bark.vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])];
            angle += turned_to(v.angle, first) / count;
            height += v.height / count;
        }
        const AxisFrame frame = m_axis.at(height);
        if (m_plan.is_piece) std::reverse(corners.begin(), corners.begin() + count);
        m_bark.faces.push_back({corners, m_rays.hit(frame.centre, frame.direction(angle)).triangle});
    }

    const WallPlan& m_plan;
    const BranchAxis& m_axis;
    const TreeRays& m_rays;
    double m_down;  // towards the cut: -1 on the stub, 1 on the piece
    BranchBark m_bark;
    std::vector<std::int32_t> m_first_of_node;
    std::int32_t m_first_row = 0;
    std::size_t m_rows = 0;
};

}  // namespace

std::vector<EdgeNode> edge_nodes(const BreakEnds& ends) {
    const CellCorners& cells = ends.cells;
    std::vector<EdgeNode> nodes;
    for (int s = 0; s < cells.sectors; ++s)
        nodes.push_back({cells.of(cells.rings - 1, s > 0 ? s - 1 : cells.sectors - 1)[2],
                         cells.of(cells.rings - 1, s)[1]});
    return nodes;
}

BranchBark make_bark(const WallPlan& plan, const BranchAxis& axis, const TreeRays& rays) {
    return BarkMaker(plan, axis, rays).make();
}

}  // namespace windfall::fracture
