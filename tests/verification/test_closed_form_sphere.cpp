// Drying of a sphere before it wrinkles, against the closed form (docs/drying.md): in the incompressible
// limit
//   flesh r^3 = a^3 + theta^3 (R^3 - a^3), skin r^3 = r_1^3 + (R^3 - 1), r_1 = r(1),
//   d sigma_r / dr = 2 (sigma_t - sigma_r) / r, sigma_t - sigma_r = mu (L^2 - L^-4), sigma_r = 0 outside.
#include <gtest/gtest.h>

#include <cmath>

#include "drying/drying_path.h"
#include "drying/element.h"

namespace windfall::drying {
namespace {

constexpr double kStone = 0.4;
constexpr double kSkin = 0.04;
constexpr double kGamma = 10;

double exact_radius(double rest_radius, double theta) {
    const auto flesh_cubed = [&](double R) {
        return std::pow(kStone, 3) + std::pow(theta, 3) * (std::pow(R, 3) - std::pow(kStone, 3));
    };
    if (rest_radius <= 1) return std::cbrt(flesh_cubed(rest_radius));
    return std::cbrt(flesh_cubed(1) + std::pow(rest_radius, 3) - 1);
}

/// sigma_t - sigma_r at a fresh radius, in C0 of the flesh.
double stress_difference(double rest_radius, double theta) {
    const double r = exact_radius(rest_radius, theta);
    const double stretch = r / ((rest_radius <= 1 ? theta : 1) * rest_radius);
    return 2 * (rest_radius <= 1 ? 1 : kGamma) * (std::pow(stretch, 2) - std::pow(stretch, -4));
}

/// Radial stress by integrating inwards from the free outer surface.
double exact_radial_stress(double rest_radius, double theta) {
    constexpr int kIntervals = 4000;
    double stress = 0;
    double outer = 1 + kSkin;
    for (int i = 1; i <= kIntervals; ++i) {
        const double inner = 1 + kSkin + (rest_radius - 1 - kSkin) * i / kIntervals;
        const double middle = 0.5 * (inner + outer);
        stress -= 2 * stress_difference(middle, theta) / exact_radius(middle, theta) *
                  (exact_radius(outer, theta) - exact_radius(inner, theta));
        outer = inner;
    }
    return stress;
}

DryingPath perfect_sphere(int n, int layers, double bulk_ratio) {
    DryingParameters parameters;
    parameters.material.bulk_ratio = bulk_ratio;
    parameters.solver.viscosity = parameters.solver.late_viscosity = 0;
    parameters.solver.newton_tolerance = 1e-3;
    const double growth = layers == 16 ? 1.1 : 1.35;
    return {geometry::make_layered_mesh(geometry::SphereShape(1, kStone), kSkin, {n, n, n},
                                        geometry::graded_layers(layers - 2, 2, growth)),
            parameters};
}

/// Largest relative error over the layers of the mean radius of a layer's nodes.
double radius_error(const DryingPath& path) {
    const geometry::LayeredMesh& mesh = path.mesh();
    const auto positions = path.positions();
    double worst = 0;
    for (int k = 0; k < mesh.layers; ++k) {
        double mean = 0;
        for (std::size_t c = 0; c < mesh.columns(); ++c)
            mean += positions[c * mesh.layers + k].norm() / static_cast<double>(mesh.columns());
        const double exact = exact_radius(mesh.nodes[k].norm(), 1 - path.shrinkage());
        worst = std::max(worst, std::abs(mean / exact - 1));
    }
    return worst;
}

TEST(ClosedFormSphere, RadiusErrorFallsLikeOneOverTheBulkRatio) {
    constexpr double kShrinkage = 0.06;
    std::vector<double> scaled;
    double last = 0;
    for (const double bulk_ratio : {50.0, 200.0, 1000.0}) {
        DryingPath path = perfect_sphere(16, 8, bulk_ratio);
        path.advance(kShrinkage, {});
        last = radius_error(path);
        scaled.push_back(last * bulk_ratio);
    }
    EXPECT_LE(last, 2e-4);
    // The error is the compressibility's: its product with the bulk ratio changes by the mesh's small part
    // only.
    for (const double value : scaled) EXPECT_NEAR(value, 0.1, 0.015);
}

TEST(ClosedFormSphere, RadialStressFollowsTheDifferentialEquation) {
    constexpr double kShrinkage = 0.06;
    DryingPath path = perfect_sphere(16, 16, 1000);
    path.advance(kShrinkage, {});
    const double theta = 1 - kShrinkage;
    const geometry::LayeredMesh& mesh = path.mesh();
    const LayerModuli moduli = layer_moduli(mesh.flesh_layers, mesh.layers, kGamma, 1000);
    geometry::LayeredMesh now = mesh;
    now.nodes = path.positions();
    const double largest = std::abs(exact_radial_stress(1, theta));
    ASSERT_GT(largest, 0.01);
    for (int k = 0; k < mesh.layers; ++k) {
        double mean = 0;
        double volume = 0;
        for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q) {
            const double own = k < mesh.flesh_layers ? theta : 1;
            const HexState state =
                hexahedron_state(element_nodes(mesh, q, k), element_nodes(now, q, k),
                                 {moduli.shear[k], moduli.bulk[k], own * Eigen::Matrix3d::Identity()});
            Eigen::Vector3d radial = Eigen::Vector3d::Zero();
            for (const auto v : mesh.brick.quads[q]) radial += mesh.directions[v];
            radial.normalize();
            mean += state.volume * radial.dot(state.stress * radial);
            volume += state.volume;
        }
        mean /= volume;
        const double inner = mesh.node(0, k).norm();
        const double outer = mesh.node(0, k + 1).norm();
        const double exact = exact_radial_stress(0.5 * (inner + outer), theta);
        EXPECT_NEAR(mean, exact, 0.02 * largest) << "layer " << k;
    }
}

TEST(ClosedFormSphere, EnergyConvergesAtSecondOrderInMeshSize) {
    std::vector<double> energies;
    for (const int n : {8, 16, 32}) {
        DryingPath path = perfect_sphere(n, 8, 50);
        path.advance(0.05, {});
        energies.push_back(path.state().history.back().elastic_energy);
    }
    const double rate = std::log2((energies[0] - energies[1]) / (energies[1] - energies[2]));
    EXPECT_NEAR(rate, 2, 0.25);
}

TEST(ClosedFormSphere, StaysRoundBeforeOnset) {
    DryingPath path = perfect_sphere(16, 8, 50);
    path.advance(0.07, {});
    for (const double depth : path.skin_depth()) EXPECT_LT(std::abs(depth), 0.05 * kSkin);
    EXPECT_LT(path.onset(), 0);
}

}  // namespace
}  // namespace windfall::drying
