#include "geometry/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

namespace windfall::geometry {

namespace {

constexpr std::int32_t kTrianglesPerLeaf = 4;
/// A tree cut in halves over 2^31 triangles is 31 deep; a search keeps at most one more node a level.
constexpr int kDeepest = 64;

double box_distance_sq(const Vec3& low, const Vec3& high, const Vec3& point) {
    return (low - point).cwiseMax(0.0).cwiseMax(point - high).squaredNorm();
}

}  // namespace

Vec3 nearest_weights(const Vec3& point, const std::array<Vec3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const Vec3 ab = b - a, ac = c - a;
    const Vec3 ap = point - a, bp = point - b, cp = point - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    return Vec3(va, vb, vc) / (va + vb + vc);
}

TriangleTree::TriangleTree(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles)
    : m_order(triangles.size()) {
    if (triangles.empty()) return;
    std::iota(m_order.begin(), m_order.end(), 0);
    std::vector<Vec3> centres;
    centres.reserve(triangles.size());
    for (const Triangle& t : triangles)
        centres.emplace_back((positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3);
    m_nodes.reserve(triangles.size());
    build(0, static_cast<std::int32_t>(triangles.size()), centres);
    m_corners.reserve(triangles.size());
    for (const std::int32_t t : m_order)
        m_corners.push_back(
            {positions[triangles[t][0]], positions[triangles[t][1]], positions[triangles[t][2]]});
    // Children stand behind their parent, so boxes are joined from the back.
    for (std::size_t i = m_nodes.size(); i-- > 0;) {
        Node& node = m_nodes[i];
        if (node.leaf()) {
            node.low = node.high = m_corners[node.begin][0];
            for (std::int32_t slot = node.begin; slot < node.end; ++slot)
                for (const Vec3& p : m_corners[slot]) {
                    node.low = node.low.cwiseMin(p);
                    node.high = node.high.cwiseMax(p);
                }
        } else {
            node.low = m_nodes[node.left].low.cwiseMin(m_nodes[node.right].low);
            node.high = m_nodes[node.left].high.cwiseMax(m_nodes[node.right].high);
        }
    }
}

std::int32_t TriangleTree::build(std::int32_t begin, std::int32_t end, const std::vector<Vec3>& centres) {
    const auto index = static_cast<std::int32_t>(m_nodes.size());
    Node node;
    node.begin = begin;
    node.end = end;
    m_nodes.push_back(node);
    if (end - begin <= kTrianglesPerLeaf) return index;
    Vec3 low = centres[m_order[begin]], high = low;
    for (std::int32_t i = begin; i < end; ++i) {
        low = low.cwiseMin(centres[m_order[i]]);
        high = high.cwiseMax(centres[m_order[i]]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const std::int32_t middle = (begin + end) / 2;
    std::nth_element(m_order.begin() + begin, m_order.begin() + middle, m_order.begin() + end,
                     [&](std::int32_t a, std::int32_t b) {
                         return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis]
                                                                     : a < b;
                     });
    const std::int32_t left = build(begin, middle, centres);
    const std::int32_t right = build(middle, end, centres);
    m_nodes[index].left = left;
    m_nodes[index].right = right;
    return index;
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& point, const Vec3& facing, double within) const {
    Nearest best;
    best.distance_sq = within * within;
    best.place.triangle = -1;
    if (m_nodes.empty()) return best;
    const bool any_facing = facing.isZero(0);
    std::array<std::int32_t, kDeepest> stack{};
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Node& node = m_nodes[stack[--depth]];
        if (box_distance_sq(node.low, node.high, point) >= best.distance_sq) continue;
        if (!node.leaf()) {
            const Node& left = m_nodes[node.left];
            const Node& right = m_nodes[node.right];
            const bool left_first =
                box_distance_sq(left.low, left.high, point) < box_distance_sq(right.low, right.high, point);
            stack[depth++] = left_first ? node.right : node.left;
            stack[depth++] = left_first ? node.left : node.right;
            continue;
        }
        for (std::int32_t slot = node.begin; slot < node.end; ++slot) {
            const auto& corners = m_corners[slot];
            if (!any_facing && (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(facing) <= 0)
                continue;
            const Vec3 weights = nearest_weights(point, corners);
            const Vec3 near = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
            const double distance_sq = (near - point).squaredNorm();
            if (distance_sq < best.distance_sq) best = {{m_order[slot], weights}, near, distance_sq};
        }
    }
    return best;
}

void TriangleTree::visit_leaves(const Node& a, const Node& b,
                                const std::function<void(std::int32_t, std::int32_t)>& visit) const {
    const auto box = [&](std::int32_t slot) {
        const auto& c = m_corners[slot];
        return std::pair<Vec3, Vec3>{c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])};
    };
    for (std::int32_t i = a.begin; i < a.end; ++i) {
        const auto [low, high] = box(i);
        for (std::int32_t j = &a == &b ? i + 1 : b.begin; j < b.end; ++j) {
            const auto [other_low, other_high] = box(j);
            if ((low.array() > other_high.array()).any() || (other_low.array() > high.array()).any())
                continue;
            visit(std::min(m_order[i], m_order[j]), std::max(m_order[i], m_order[j]));
        }
    }
}

void TriangleTree::for_each_pair(const std::function<void(std::int32_t, std::int32_t)>& visit) const {
    if (m_nodes.empty()) return;
    std::vector<std::pair<std::int32_t, std::int32_t>> stack{{0, 0}};
    while (!stack.empty()) {
        const auto [i, j] = stack.back();
        stack.pop_back();
        const Node& a = m_nodes[i];
        const Node& b = m_nodes[j];
        if ((a.low.array() > b.high.array()).any() || (b.low.array() > a.high.array()).any()) continue;
        if (a.leaf() && b.leaf()) {
            visit_leaves(a, b, visit);
        } else if (i == j) {
            stack.insert(stack.end(), {{a.left, a.left}, {a.right, a.right}, {a.left, a.right}});
        } else if (b.leaf() || (!a.leaf() && a.end - a.begin > b.end - b.begin)) {
            stack.insert(stack.end(), {{a.left, j}, {a.right, j}});
        } else {
            stack.insert(stack.end(), {{i, b.left}, {i, b.right}});
        }
    }
}

}  // namespace windfall::geometry
