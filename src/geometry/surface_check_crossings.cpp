#include "geometry/surface_check_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/triangle_tree.h"

namespace windfall::geometry {

namespace {

/// Heights below this share of the surface's diagonal count as lying in the plane.
constexpr double kInPlane = 1e-10;

/// Where the segment p q pierces the inside of a triangle.
std::optional<Vec3> piercing(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t, double in_plane) {
    const Vec3 area = (t[1] - t[0]).cross(t[2] - t[0]);
    const double height_p = area.dot(p - t[0]), height_q = area.dot(q - t[0]);
    const double least = in_plane * area.norm();
    if (!(std::min(height_p, height_q) < -least && std::max(height_p, height_q) > least)) return {};
    const Vec3 x = p + height_p / (height_p - height_q) * (q - p);
    for (int k = 0; k < 3; ++k)
        if (area.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) < 0) return {};
    return x;
}

}  // namespace

std::vector<Crossing> self_crossings(const TriangleSurface& surface) {
    const double in_plane = kInPlane * diagonal_of(surface.positions);
    const auto corners = [&](std::int32_t t) -> std::array<Vec3, 3> {
        const auto& [a, b, c] = surface.triangles[t];
        return {surface.positions[a], surface.positions[b], surface.positions[c]};
    };
    std::vector<Crossing> crossings;
    TriangleTree(surface.positions, surface.triangles).for_each_pair([&](std::int32_t i, std::int32_t j) {
        const Triangle& first = surface.triangles[i];
        const Triangle& second = surface.triangles[j];
        int shared = 0;
        for (const std::int32_t v : first) shared += std::count(second.begin(), second.end(), v) > 0 ? 1 : 0;
        if (shared > 1) return;
        const auto a = corners(i), b = corners(j);
        for (int k = 0; k < 3; ++k) {
            const auto has = [&](const Triangle& t, std::int32_t v) {
                return std::find(t.begin(), t.end(), v) != t.end();
            };
            const int next = (k + 1) % 3;
            std::optional<Vec3> place;
            // An edge from a shared vertex starts in the other triangle's plane: the two others decide.
            if (!has(second, first[k]) && !has(second, first[next]))
                place = piercing(a[k], a[next], b, in_plane);
            if (!place && !has(first, second[k]) && !has(first, second[next]))
                place = piercing(b[k], b[next], a, in_plane);
            if (!place) continue;
            crossings.push_back({i, j, *place});
            return;
        }
    });
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
    });
    return crossings;
}

}  // namespace windfall::geometry
