#include "drying/newton.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/small_body.h"

namespace windfall::drying {
namespace {

struct Body {
    geometry::LayeredMesh mesh;
    Multigrid multigrid;
    Elasticity elasticity;
    NewtonSolver newton;
    AlignedArray<double> start;

    explicit Body(int n)
        : mesh(test::small_sphere(n, 8)),
          multigrid(mesh.brick, 8, kernels(8)),
          elasticity(mesh, layer_moduli(mesh.flesh_layers, 8, 10, 50), multigrid),
          newton(elasticity),
          start(elasticity.size()) {}

    void dry(double theta) {
        const int flesh = mesh.flesh_layers;
        elasticity.set_drying([theta, flesh](std::size_t, int layer) -> Eigen::Matrix3d {
            return (layer < flesh ? theta : 1.0) * Eigen::Matrix3d::Identity();
        });
    }
};

TEST(Newton, PotentialNeverRises) {
    Body body(8);
    body.dry(0.985);
    AlignedArray<double> u = test::random_displacement(body.elasticity.size(), 0.003, 1);
    NewtonSettings settings;
    settings.tolerance = 1e-3;
    settings.radius = 0.1;
    settings.max_iterations = 40;
    settings.max_rejections = 10;
    const NewtonResult result = body.newton.minimize(u, {&body.start, 5}, settings, {});
    EXPECT_TRUE(result.converged);
    ASSERT_GE(result.potentials.size(), 3U);
    for (std::size_t i = 1; i < result.potentials.size(); ++i)
        EXPECT_LE(result.potentials[i], result.potentials[i - 1] * (1 + 1e-12));
    EXPECT_LT(result.potentials.back(), 0.9 * result.potentials.front());
}

TEST(Newton, ConvergesFasterThanLinearlyNearTheMinimum) {
    Body body(8);
    body.dry(0.99);
    AlignedArray<double> u(body.elasticity.size());
    NewtonSettings settings;
    settings.radius = 1;
    settings.tolerance = 1e-5;
    settings.max_iterations = 12;
    const NewtonResult result = body.newton.minimize(u, {}, settings, {});
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.newton_steps, 7);
}

TEST(Newton, FreshBodyStaysAtRest) {
    Body body(8);
    AlignedArray<double> u(body.elasticity.size());
    NewtonSettings settings;
    settings.radius = 1;
    const NewtonResult result = body.newton.minimize(u, {}, settings, {});
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.newton_steps, 0);
    // The kernels round: no force is left but that.
    EXPECT_LT(result.residual, 1e-12);
}

TEST(Newton, DampingHoldsTheBodyBack) {
    Body body(8);
    body.dry(0.985);
    NewtonSettings settings;
    settings.radius = 1;
    settings.tolerance = 1e-3;
    AlignedArray<double> free_motion(body.elasticity.size());
    AlignedArray<double> damped(body.elasticity.size());
    ASSERT_TRUE(body.newton.minimize(free_motion, {&body.start, 0}, settings, {}).converged);
    ASSERT_TRUE(body.newton.minimize(damped, {&body.start, 1e5}, settings, {}).converged);
    const auto length = [](const AlignedArray<double>& a) {
        double sum = 0;
        for (const double x : a) sum += x * x;
        return std::sqrt(sum);
    };
    EXPECT_LT(length(damped), 0.7 * length(free_motion));
}

TEST(Newton, InvertedStartIsNotTaken) {
    Body body(4);
    AlignedArray<double> u(body.elasticity.size());
    u[7] = 5;
    EXPECT_FALSE(std::isfinite(body.newton.potential(u, {})));
    NewtonSettings settings;
    settings.radius = 1;
    EXPECT_FALSE(body.newton.minimize(u, {}, settings, {}).converged);
}

}  // namespace
}  // namespace windfall::drying
