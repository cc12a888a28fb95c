#include "geometry/sphere_map_interior.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/cube_atlas.h"
#include "geometry/layered_mesh.h"
#include "geometry/sphere_map_unfold.h"

namespace windfall::geometry {

namespace {

constexpr int kLevels = 6;
constexpr int kFewestInteriorCells = 4, kMostInteriorCells = 32;
/// Share of its designed volume that every corner must keep.
constexpr double kLeastRatio = 1e-3;
/// The surface's relief between the columns dies away inwards with this power of the fraction.
constexpr double kReliefPower = 4;

/// Nodes of a ball: [level * columns + column] with the surface's level last but for the centre, which is
/// node `centre`. Free nodes come first, as `unfold` wants them.
struct BallNodes {
    std::size_t columns;
    std::int32_t node(int level, std::int32_t column) const {
        if (level == 0) return static_cast<std::int32_t>((kLevels - 1) * columns);
        const std::size_t behind_centre = level == kLevels ? 1 : 0;
        return static_cast<std::int32_t>((level - 1) * columns + column + behind_centre);
    }
    std::size_t free() const { return (kLevels - 1) * columns + 1; }
    std::size_t count() const { return kLevels * columns + 1; }
};

/// Every corner of every hexahedron, and of the pyramids around the centre.
std::vector<DesignedElement> corner_elements(const BrickSurface& brick, const BallNodes& ball,
                                             const std::vector<Vec3>& directions) {
    std::vector<DesignedElement> elements;
    elements.reserve(8 * kLevels * brick.quads.size());
    const auto add = [&](const std::array<std::pair<int, std::int32_t>, 4>& places) {
        DesignedElement element;
        std::array<Vec3, 4> x;
        for (int i = 0; i < 4; ++i) {
            const auto& [level, column] = places[i];
            element.node[i] = ball.node(level, column);
            x[i] = level / static_cast<double>(kLevels) * directions[column];
        }
        for (int i = 0; i < 3; ++i) element.design.col(i) = x[i + 1] - x[0];
        if (element.design.determinant() < 0) {
            std::swap(element.node[1], element.node[2]);
            element.design.col(0).swap(element.design.col(1));
        }
        elements.push_back(element);
    };
    for (const Quad& quad : brick.quads)
        for (int c = 0; c < 4; ++c) {
            const std::int32_t here = quad[c], next = quad[(c + 1) % 4], previous = quad[(c + 3) % 4];
            add({{{0, here}, {1, here}, {1, next}, {1, previous}}});
            for (int level = 1; level < kLevels; ++level) {
                add({{{level, here}, {level, next}, {level, previous}, {level + 1, here}}});
                add({{{level + 1, here}, {level + 1, next}, {level + 1, previous}, {level, here}}});
            }
        }
    return elements;
}

}  // namespace

SphereInterior::SphereInterior(const SphereMap& map, int cells) : m_map(map) {
    if (cells < kFewestInteriorCells || cells > kMostInteriorCells)
        throw InputError(fmt::format("an interior of {} cells along an edge cannot be: give {} to {}", cells,
                                     kFewestInteriorCells, kMostInteriorCells));
    m_brick = make_brick_surface({cells, cells, cells});
    const auto directions = brick_directions(m_brick, Vec3::Ones());
    const BallNodes ball{directions.size()};
    std::vector<Vec3> nodes(ball.count(), Vec3::Zero());
    for (std::size_t c = 0; c < directions.size(); ++c)
        nodes[ball.node(kLevels, static_cast<std::int32_t>(c))] = map.point(directions[c]);
    const auto elements = corner_elements(m_brick, ball, directions);
    const WorstElement worst = unfold(nodes, ball.free(), elements);
    if (!(worst.ratio > kLeastRatio)) {
        const Vec3& place = nodes[elements[worst.element].node[0]];
        throw InputError(
            fmt::format("the inside of the fruit folds over near ({:.4g}, {:.4g}, {:.4g}) m: smooth "
                        "the surface around it, or make it thicker there",
                        place.x(), place.y(), place.z()));
    }
    m_nodes.resize(nodes.size());
    for (int level = 1; level <= kLevels; ++level)
        for (std::size_t c = 0; c < directions.size(); ++c)
            m_nodes[(level - 1) * directions.size() + c] =
                nodes[ball.node(level, static_cast<std::int32_t>(c))];
    m_nodes.back() = nodes[ball.node(0, 0)];
}

Vec3 SphereInterior::point(const Vec3& direction, double fraction) const {
    const CubeAtlas::ChartPoint p = CubeAtlas::chart_point(direction);
    const auto& vertices = m_brick.side_vertices[p.chart];
    const int cells = m_brick.cells[0];
    const double s = std::clamp(p.s, 0.0, 1.0) * cells, t = std::clamp(p.t, 0.0, 1.0) * cells;
    const int i = std::min(static_cast<int>(s), cells - 1), j = std::min(static_cast<int>(t), cells - 1);
    const std::size_t columns = m_brick.vertex_count();
    const auto at_level = [&](int level) -> Vec3 {
        if (level == 0) return m_nodes.back();
        const auto node = [&](int di, int dj) -> const Vec3& {
            return m_nodes[(level - 1) * columns + vertices[(j + dj) * (cells + 1) + i + di]];
        };
        const double u = s - i, v = t - j;
        return (1 - v) * ((1 - u) * node(0, 0) + u * node(1, 0)) +
               v * ((1 - u) * node(0, 1) + u * node(1, 1));
    };
    const double depth = std::clamp(fraction, 0.0, 1.0) * kLevels;
    const int level = std::min(static_cast<int>(depth), kLevels - 1);
    const Vec3 inside = at_level(level) + (depth - level) * (at_level(level + 1) - at_level(level));
    const Vec3 relief = m_map.point(direction) - at_level(kLevels);
    return inside + std::pow(std::clamp(fraction, 0.0, 1.0), kReliefPower) * relief;
}

}  // namespace windfall::geometry
