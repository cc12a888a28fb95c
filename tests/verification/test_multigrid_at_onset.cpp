// The preconditioner where it is hardest: wrinkles that have just appeared and move almost freely.
#include <gtest/gtest.h>

#include <limits>

#include "drying/drying_path.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

constexpr double kShrinkage = 0.095;
constexpr double kNext = 0.002;

/// Linear iterations from the equilibrium at kShrinkage for the force that a little more drying puts out of
/// balance.
int iterations(DryingPath& path, const DryingParameters& parameters, std::size_t krylov_columns) {
    const geometry::LayeredMesh& mesh = path.mesh();
    Multigrid multigrid(mesh.brick, mesh.layers, kernels(mesh.layers), krylov_columns);
    Elasticity elasticity(mesh,
                          layer_moduli(mesh.flesh_layers, mesh.layers, parameters.material.gamma,
                                       parameters.material.bulk_ratio),
                          multigrid);
    const AlignedArray<double>& displacement = path.state().displacements.front();
    const RecipeDrying drying(mesh, parameters.drying);
    elasticity.set_drying(drying.at(kShrinkage + kNext));
    elasticity.assemble(displacement, 1, parameters.drying.shrinkage / kNext);
    EXPECT_TRUE(multigrid.set_up());
    AlignedArray<double> force(elasticity.size());
    elasticity.energy(displacement, &force);
    AlignedArray<float> right(force.size());
    for (std::size_t i = 0; i < right.size(); ++i)
        right[i] = static_cast<float>(-force[i] / path.reference_force());
    AlignedArray<float> step(force.size());
    ConjugateGradients solver(multigrid, elasticity.mean_weights());
    const LinearResult result =
        solver.solve(right, step, 1e-3, 200, std::numeric_limits<double>::infinity(), {});
    EXPECT_EQ(result.status, LinearStatus::Converged);
    return result.iterations;
}

TEST(MultigridAtOnset, TwoIterationsOnCoarseLevelsSaveIterationsOnTheFinest) {
    DryingParameters parameters;
    parameters.mesh.n = 64;
    parameters.mesh.layers = 8;
    parameters.fruit.skin_thickness = 0.03;
    const auto shape = make_shape(parameters.fruit);
    geometry::LayeredMesh mesh = make_mesh(parameters, *shape);
    add_noise(mesh, parameters);
    DryingPath path(std::move(mesh), parameters);
    path.advance(kShrinkage, {});
    const int plain = iterations(path, parameters, std::numeric_limits<std::size_t>::max());
    const int two = iterations(path, parameters, 1000);
    EXPECT_LT(two, 0.8 * plain) << plain << " with a plain cycle, " << two << " with two iterations";
}

}  // namespace
}  // namespace windfall::drying
