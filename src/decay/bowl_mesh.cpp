#include "decay/bowl_mesh.h"

#include <cmath>
#include <numbers>

namespace windfall::decay {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr int kAround = 96, kProfile = 24;
constexpr double kWall_m = 0.004;

/// Half of the cross-section, from the middle of the inside over the rim to the middle of the foot: (distance
/// from the axis, height).
std::vector<Vec2> bowl_profile(double radius, double height) {
    const double rim = std::acos(1 - height / radius);
    std::vector<Vec2> profile;
    for (int i = 1; i <= kProfile; ++i) {
        const double angle = rim * i / kProfile;
        profile.emplace_back(radius * std::sin(angle), radius * (1 - std::cos(angle)));
    }
    // The rim is half a circle across the wall, about its middle.
    const Vec2 outwards(std::sin(rim), -std::cos(rim)), upwards(std::cos(rim), std::sin(rim));
    const Vec2 middle = profile.back() + 0.5 * kWall_m * outwards;
    for (int i = 1; i < 8; ++i) {
        const double angle = std::numbers::pi * i / 8;
        profile.emplace_back(middle +
                             0.5 * kWall_m * (std::sin(angle) * upwards - std::cos(angle) * outwards));
    }
    // The outside stops at the table: there the bowl stands on a foot.
    for (int i = kProfile; i >= 1; --i) {
        const double angle = rim * i / kProfile;
        const Vec2 point((radius + kWall_m) * std::sin(angle), radius - (radius + kWall_m) * std::cos(angle));
        profile.emplace_back(point.x(), std::max(point.y(), 0.0));
    }
    return profile;
}

}  // namespace

geometry::SurfaceMesh bowl_mesh(double radius_m, double height_m) {
    const std::vector<Vec2> profile = bowl_profile(radius_m, height_m);
    geometry::SurfaceMesh mesh;
    const auto rows = static_cast<std::int32_t>(profile.size());
    for (const Vec2& p : profile)
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2 * std::numbers::pi * k / kAround;
            mesh.positions.emplace_back(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
        }
    const auto inside = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, profile.back().y());
    const auto at = [](std::int32_t row, int k) { return row * kAround + (k + kAround) % kAround; };
    for (int k = 0; k < kAround; ++k) {
        mesh.faces.push_back({inside, at(0, k), at(0, k + 1), geometry::kNoVertex});
        for (std::int32_t row = 0; row + 1 < rows; ++row)
            mesh.faces.push_back({at(row, k), at(row + 1, k), at(row + 1, k + 1), at(row, k + 1)});
        mesh.faces.push_back({inside + 1, at(rows - 1, k + 1), at(rows - 1, k), geometry::kNoVertex});
    }
    return mesh;
}

}  // namespace windfall::decay
