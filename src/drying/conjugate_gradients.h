#pragma once
// Preconditioned conjugate gradients inside a trust region (Steihaug 1983).
#include <functional>

#include "core/run_context.h"
#include "drying/multigrid.h"

namespace windfall::drying {

enum class LinearStatus {
    Converged,          ///< the residual fell below the tolerance
    OnBoundary,         ///< the step reached the trust region's radius
    NegativeCurvature,  ///< a direction of negative curvature was followed to the radius
    IterationLimit,
    NotDefinite,  ///< the preconditioner is not positive definite; there is no step
};

struct LinearResult {
    LinearStatus status = LinearStatus::Converged;
    int iterations = 0;
    double relative_residual = 1;
};

/// Adds to y what a symmetric matrix beside the multigrid's makes of x; returns what that adds to x y.
using AddedProduct = std::function<double(const float* x, float* y)>;

/// Solves A x = b with the multigrid's finest matrix, plus an added one if there is any. Single precision
/// vectors, double sums in a fixed order.
class ConjugateGradients {
  public:
    /// `mass`: [column][layers], weights of the norm that the trust region is measured in, of sum 1.
    ConjugateGradients(Multigrid& multigrid, const AlignedArray<float>& mass, AddedProduct added = {});

    /// Starts from x = 0. `radius` is the largest mass-weighted root mean square of x; infinity for none.
    LinearResult solve(const AlignedArray<float>& b, AlignedArray<float>& x, double tolerance,
                       int max_iterations, double radius, const RunContext& context);

    /// Mass-weighted root mean square.
    double length(const AlignedArray<float>& x) const;

  private:
    /// Mass-weighted inner products of x, the solution so far, and p, the direction.
    struct Lengths {
        double xx = 0, xp = 0, pp = 0;
    };
    /// Calls update(i), which changes x[i] and p[i], for all i, then takes the products; in one pass.
    template <class Update>
    Lengths updated_lengths(const float* x, const float* p, const Update& update) const;

    Multigrid& m_multigrid;
    const AlignedArray<float>& m_mass;
    AddedProduct m_added;
    AlignedArray<float> m_residual, m_preconditioned, m_direction, m_product;
};

}  // namespace windfall::drying
