#pragma once
// The scalar Laplacian that stands in for the flesh's Hessian: factored once in a while, solved for x, y, z
// at once.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "decay/tetrahedra.h"

namespace windfall::decay {

/// L = sum_e w_e grad N_i . grad N_j + diag, as sparse L D L^T.
class FleshPreconditioner {
  public:
    /// Orders the unknowns and finds the pattern of the factor.
    explicit FleshPreconditioner(const FleshMesh& mesh);
    FleshPreconditioner(const FleshPreconditioner&) = delete;
    FleshPreconditioner& operator=(const FleshPreconditioner&) = delete;
    FleshPreconditioner(FleshPreconditioner&&) noexcept;
    FleshPreconditioner& operator=(FleshPreconditioner&&) noexcept;
    ~FleshPreconditioner();

    /// `weights` per element, `diagonal` per node, all positive. Throws RunError if the matrix is not
    /// definite.
    void factorise(const std::vector<float>& weights, const std::vector<float>& diagonal);

    /// result = L^-1 right (component by component).
    void solve(const std::vector<Eigen::Vector4f>& right, std::vector<Eigen::Vector4f>& result) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

}  // namespace windfall::decay
