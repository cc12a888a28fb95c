#include "drying/multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/parallel.h"
#include "drying/conjugate_gradients.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

constexpr double kNoRadius = std::numeric_limits<double>::infinity();

struct Body {
    geometry::LayeredMesh mesh;
    Multigrid multigrid;
    Elasticity elasticity;

    explicit Body(int n, int layers = 8, std::size_t krylov_columns = Multigrid::kKrylovColumns)
        : mesh(test::small_sphere(n, layers)),
          multigrid(mesh.brick, layers, kernels(layers), krylov_columns),
          elasticity(mesh, layer_moduli(mesh.flesh_layers, layers, 10, 50), multigrid) {
        elasticity.assemble(AlignedArray<double>(elasticity.size()), 1, 0);
    }

    AlignedArray<float> apply(const AlignedArray<float>& b) {
        AlignedArray<float> x(b.size());
        multigrid.apply(b.data(), x.data());
        return x;
    }
};

AlignedArray<float> random_vector(std::size_t size, std::uint64_t seed) {
    const AlignedArray<double> values = test::random_displacement(size, 1, seed);
    AlignedArray<float> result(size);
    std::copy(values.begin(), values.end(), result.begin());
    return result;
}

double dot(const AlignedArray<float>& a, const AlignedArray<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
    return sum;
}

TEST(Multigrid, CycleIsNearlySymmetricAndPositive) {
    for (const int layers : {8, 16}) {
        Body body(8, layers);
        ASSERT_TRUE(body.multigrid.set_up());
        const AlignedArray<float> a = random_vector(body.elasticity.size(), 1);
        const AlignedArray<float> b = random_vector(body.elasticity.size(), 2);
        const AlignedArray<float> ma = body.apply(a);
        const AlignedArray<float> mb = body.apply(b);
        EXPECT_GT(dot(a, ma), 0);
        EXPECT_GT(dot(b, mb), 0);
        // The coarsest level is solved to 1e-2, and half precision rounds the inverse blocks.
        EXPECT_NEAR(dot(a, mb), dot(b, ma), 1e-2 * std::sqrt(dot(a, ma) * dot(b, mb)));
    }
}

TEST(Multigrid, ContractionDoesNotDependOnMeshSize) {
    std::vector<int> iterations;
    for (const int n : {8, 16, 32}) {
        Body body(n);
        ASSERT_TRUE(body.multigrid.set_up());
        ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
        const AlignedArray<float> b = random_vector(body.elasticity.size(), 3);
        AlignedArray<float> x(b.size());
        const LinearResult result = solver.solve(b, x, 1e-5, 200, kNoRadius, {});
        EXPECT_EQ(result.status, LinearStatus::Converged);
        iterations.push_back(result.iterations);
    }
    EXPECT_LE(iterations.back(), 40);
    EXPECT_LE(iterations[2], iterations[0] + 4);
}

TEST(Multigrid, TwoIterationsOnLargeLevelsLeadToTheSameSolution) {
    std::vector<AlignedArray<float>> solutions;
    for (const std::size_t krylov_columns : {std::size_t{100000}, std::size_t{300}}) {
        Body body(32, 8, krylov_columns);
        ASSERT_TRUE(body.multigrid.set_up());
        ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
        const AlignedArray<float> b = random_vector(body.elasticity.size(), 3);
        AlignedArray<float> x(b.size());
        const LinearResult result = solver.solve(b, x, 1e-5, 200, kNoRadius, {});
        EXPECT_EQ(result.status, LinearStatus::Converged);
        solutions.push_back(std::move(x));
    }
    AlignedArray<float> difference = solutions[0];
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= solutions[1][i];
    EXPECT_GT(dot(difference, difference), 0);
    EXPECT_LT(dot(difference, difference), 1e-6 * dot(solutions[0], solutions[0]));
}

TEST(Multigrid, SameBitsForAnyThreadCount) {
    std::vector<AlignedArray<float>> solutions;
    for (const int threads : {1, 3}) {
        const ThreadLimit limit(threads);
        Body body(32, 8, 300);  // two iterations on a level of 1,538 columns
        ASSERT_TRUE(body.multigrid.set_up());
        ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
        const AlignedArray<float> b = random_vector(body.elasticity.size(), 3);
        AlignedArray<float> x(b.size());
        EXPECT_EQ(solver.solve(b, x, 1e-4, 200, 1e3, {}).status, LinearStatus::Converged);
        solutions.push_back(std::move(x));
    }
    EXPECT_EQ(std::memcmp(solutions[0].data(), solutions[1].data(), solutions[0].size() * sizeof(float)), 0);
}

TEST(Multigrid, SolutionAgreesWithADenseSolver) {
    Body body(4);
    ASSERT_TRUE(body.multigrid.set_up());
    const auto size = static_cast<Eigen::Index>(body.elasticity.size());
    Eigen::MatrixXd matrix(size, size);
    AlignedArray<float> unit(body.elasticity.size());
    AlignedArray<float> column(body.elasticity.size());
    for (Eigen::Index j = 0; j < size; ++j) {
        unit.set_zero();
        unit[static_cast<std::size_t>(j)] = 1;
        body.multigrid.product(unit.data(), column.data());
        for (Eigen::Index i = 0; i < size; ++i) matrix(i, j) = column[static_cast<std::size_t>(i)];
    }
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-6 * matrix.norm());  // single precision
    const AlignedArray<float> b = random_vector(body.elasticity.size(), 4);
    Eigen::VectorXd right(size);
    for (Eigen::Index i = 0; i < size; ++i) right[i] = b[static_cast<std::size_t>(i)];
    const Eigen::VectorXd expected = matrix.ldlt().solve(right);
    ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
    AlignedArray<float> x(b.size());
    ASSERT_EQ(solver.solve(b, x, 1e-6, 300, kNoRadius, {}).status, LinearStatus::Converged);
    Eigen::VectorXd found(size);
    for (Eigen::Index i = 0; i < size; ++i) found[i] = x[static_cast<std::size_t>(i)];
    EXPECT_LT((found - expected).norm(), 1e-4 * expected.norm());
}

TEST(Multigrid, SolverStoppedEarlyTellsItsResidual) {
    Body body(8);
    ASSERT_TRUE(body.multigrid.set_up());
    const AlignedArray<float> b = random_vector(body.elasticity.size(), 5);
    ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
    AlignedArray<float> x(b.size());
    AlignedArray<float> residual(b.size());
    for (const int limit : {1, 2, 3}) {
        const LinearResult result = solver.solve(b, x, 1e-6, limit, kNoRadius, {});
        EXPECT_EQ(result.status, LinearStatus::IterationLimit);
        EXPECT_EQ(result.iterations, limit);
        body.multigrid.product(x.data(), residual.data());
        for (std::size_t i = 0; i < b.size(); ++i) residual[i] = b[i] - residual[i];
        const double found = std::sqrt(dot(residual, residual) / dot(b, b));
        EXPECT_NEAR(result.relative_residual, found, 1e-4 * found + 1e-6);
    }
}

TEST(Multigrid, TrustRegionBoundsTheStep) {
    Body body(8);
    ASSERT_TRUE(body.multigrid.set_up());
    ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
    const AlignedArray<float> b = random_vector(body.elasticity.size(), 5);
    AlignedArray<float> free_step(b.size());
    solver.solve(b, free_step, 1e-4, 200, kNoRadius, {});
    const double radius = 0.3 * solver.length(free_step);
    AlignedArray<float> step(b.size());
    const LinearResult result = solver.solve(b, step, 1e-4, 200, radius, {});
    EXPECT_EQ(result.status, LinearStatus::OnBoundary);
    EXPECT_NEAR(solver.length(step), radius, 1e-4 * radius);
}

TEST(Multigrid, NegativeCurvatureIsFollowedToTheRadius) {
    Body body(8);
    // A negative mass of this size makes the softest directions unstable and leaves the columns' own blocks
    // definite.
    body.elasticity.assemble(AlignedArray<double>(body.elasticity.size()), 1, -30);
    ASSERT_TRUE(body.multigrid.set_up());
    ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
    const AlignedArray<float> b = random_vector(body.elasticity.size(), 6);
    AlignedArray<float> step(b.size());
    const LinearResult result = solver.solve(b, step, 1e-6, 200, 1e6, {});
    EXPECT_EQ(result.status, LinearStatus::NegativeCurvature);
    EXPECT_NEAR(solver.length(step), 1e6, 1e3);
}

TEST(Multigrid, IndefiniteBlocksAreRefused) {
    Body body(4);
    body.elasticity.assemble(AlignedArray<double>(body.elasticity.size()), 1, -1e6);
    EXPECT_FALSE(body.multigrid.set_up());
}

TEST(Multigrid, CancelStopsTheSolver) {
    Body body(4);
    ASSERT_TRUE(body.multigrid.set_up());
    ConjugateGradients solver(body.multigrid, body.elasticity.mean_weights());
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    AlignedArray<float> x(body.elasticity.size());
    EXPECT_THROW(solver.solve(random_vector(x.size(), 7), x, 1e-6, 100, kNoRadius, context), Cancelled);
}

}  // namespace
}  // namespace windfall::drying
