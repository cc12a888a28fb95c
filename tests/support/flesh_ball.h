#pragma once
// Balls of flesh of radius 1 with a thin skin, to let water diffuse in, and what is known of them.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "drying/flesh_diffusion.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

inline geometry::LayeredMesh flesh_ball(int cells, int flesh_layers, double stone_radius) {
    std::array<double, 8> radii{};
    radii.fill(1);
    const geometry::TenNumberFruit shape(radii, stone_radius, stone_radius);
    constexpr double kSkin = 0.02;
    return geometry::make_layered_mesh(shape, kSkin, {cells, cells, cells},
                                       geometry::graded_layers(flesh_layers, 2, 1));
}

// The stone of a full ball: too small to matter.
inline constexpr double kNoStone = 0.02;
// With so many solutes Raoult's law is a straight line, and evaporation proportional to the content.
inline constexpr double kManySolutes = 1e6;

inline std::vector<double> flesh_areas(const geometry::LayeredMesh& mesh) {
    std::vector<double> areas;
    for (const auto& quad : mesh.brick.quads) {
        const auto corner = [&](int c) -> const geometry::Vec3& {
            return mesh.node(quad[c], mesh.flesh_layers);
        };
        areas.push_back(0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1)).norm());
    }
    return areas;
}

/// Evaporation of `biot` times the content at the skin, over a ball of radius 1 and a diffusivity of 1.
inline SkinEvaporation proportional(const geometry::LayeredMesh& mesh, double biot) {
    SkinEvaporation skin{flesh_areas(mesh), std::vector<double>(mesh.brick.quads.size(), 0), kManySolutes};
    for (double& area : skin.leaving) area *= biot * kManySolutes;
    return skin;
}

inline double mean_of(const FleshCells& cells, const std::vector<double>& contents) {
    double sum = 0;
    for (std::size_t i = 0; i < contents.size(); ++i) sum += contents[i] * cells.volumes()[i];
    return sum / cells.volume();
}

/// Mean content of a ball that starts at 1 and loses biot * content at its surface, after the time t r^2 / D:
/// J. Crank, The mathematics of diffusion, 2nd ed. 1975, eq. (6.43).
inline double evaporating_ball(double biot, double t) {
    double sum = 0;
    constexpr int kTerms = 400;
    for (int k = 1; k <= kTerms; ++k) {
        // roots of b cot b = 1 - biot, one in each interval of length pi
        double low = (k - 1) * std::numbers::pi + 1e-9;
        double high = k * std::numbers::pi - 1e-9;
        const auto left = [biot](double b) { return b * std::cos(b) - (1 - biot) * std::sin(b); };
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            ((left(low) > 0) == (left(middle) > 0) ? low : high) = middle;
        }
        sum += 6 * biot * biot * std::exp(-low * low * t) / (low * low * (low * low + biot * (biot - 1)));
    }
    return sum;
}

/// A ball with a diffusivity of 1.
struct FleshBall {
    geometry::LayeredMesh mesh;
    FleshCells cells;
    FleshConductances conductances;
    FleshBall(int n, int layers, double stone)
        : mesh(flesh_ball(n, layers, stone)), cells(mesh), conductances(cells.conductances(mesh.nodes)) {}

    double dried(double biot, double until, int steps) const {
        const FleshDiffusion diffusion(cells, conductances, 1);
        const SkinEvaporation skin = proportional(mesh, biot);
        std::vector<double> contents(cells.size(), 1);
        for (int i = 0; i < steps; ++i) diffusion.step(contents, until / steps, skin, skin);
        return mean_of(cells, contents);
    }
};

}  // namespace windfall::drying
