#include "drying/skin_exposure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::drying {

namespace {

using geometry::Vec3;

Vec3 to_direction(const std::vector<double>& xyz) { return Vec3(xyz[0], xyz[1], xyz[2]).normalized(); }

/// Mean of a surface over its area.
Vec3 middle_of(const std::vector<Vec3>& positions, const std::vector<geometry::Face>& faces) {
    const std::vector<double> areas = geometry::vertex_areas(positions, faces);
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (std::size_t v = 0; v < areas.size(); ++v) {
        sum += areas[v] * positions[v];
        area += areas[v];
    }
    return sum / area;
}

}  // namespace

SkinExposure skin_exposure(const geometry::LayeredMesh& mesh, const MoistureParameters& parameters,
                           const SkinPaint& paint, const std::vector<geometry::Vec2>& uvs) {
    const auto& quads = mesh.brick.quads;
    SkinExposure result{std::vector<double>(quads.size(), 1), std::vector<double>(quads.size(), 0)};
    const std::vector<Vec3> skin = mesh.level_positions(mesh.layers);
    const std::vector<Shade> shades = shades_of(parameters);
    const Vec3 centre = middle_of(skin, mesh.faces());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const auto corner = [&](std::size_t c) -> const Vec3& { return skin[quads[q][c]]; };
        const Vec3 middle = (corner(0) + corner(1) + corner(2) + corner(3)) / 4;
        if (!parameters.sun_direction.empty()) {
            const Vec3 normal = (corner(2) - corner(0)).cross(corner(3) - corner(1)).normalized();
            result.sun[q] = std::max(0.0, normal.dot(to_direction(parameters.sun_direction)));
        }
        for (const Shade& shade : shades) {
            const double cosine = (middle - centre).normalized().dot(to_direction(shade.direction));
            if (cosine < std::cos(shade.half_angle_deg * std::numbers::pi / 180)) continue;
            result.transpiration[q] *= shade.factor;
            result.sun[q] = 0;
        }
        if (paint) result.transpiration[q] *= std::clamp(paint(uvs[q]), 0.0, 1.0);
    }
    return result;
}

std::vector<geometry::Vec2> atlas_middles(const geometry::BrickSurface& brick) {
    std::vector<geometry::Vec2> result;
    for (const auto& corners : geometry::brick_atlas(brick))
        result.emplace_back((corners[0] + corners[1] + corners[2] + corners[3]) / 4);
    return result;
}

double daylight(Sunshine sunshine, double hour) {
    if (sunshine == Sunshine::Always) return 1;
    constexpr double kSunrise = 6;
    constexpr double kDayLength = 12;
    return std::max(0.0, std::sin(std::numbers::pi * (hour - kSunrise) / kDayLength));
}

}  // namespace windfall::drying
