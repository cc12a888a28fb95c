#pragma once
// Preconditioner of the Newton systems: a K(1,1) cycle that coarsens the two surface directions by 2 and
// keeps the columns whole. Smoother: symmetric block Gauss-Seidel whose blocks are whole columns, in half
// precision. Coarse matrices: Galerkin. Coarsest level: nearly exact, by conjugate gradients.
#include <memory>
#include <vector>

#include "core/aligned_array.h"
#include "drying/column_order.h"
#include "geometry/brick_surface.h"

namespace windfall::drying {

class Multigrid {
  public:
    /// With at least so many columns the level below the finest takes two conjugate gradient iterations
    /// instead of one cycle. On a smaller one they save less than they cost (docs/performance.md).
    static constexpr std::size_t kKrylovColumns = 8000;

    /// `layers`: 8 or 16. Allocates everything; the finest matrix is zero. The cells
    /// can be halved at least once.
    Multigrid(const geometry::BrickSurface& brick, int layers, const KernelTable& table,
              std::size_t krylov_columns = kKrylovColumns);
    ~Multigrid();
    Multigrid(const Multigrid&) = delete;
    Multigrid& operator=(const Multigrid&) = delete;

    /// Order of columns and quads of the finest level; vectors are [column][3][layers] in it.
    const ColumnOrder& order() const;
    int layers() const { return m_layers; }
    std::size_t vector_size() const {
        return static_cast<std::size_t>(order().column_count()) * 3 * m_layers;
    }
    const KernelTable& table() const { return m_table; }

    /// The finest matrix, to be assembled into. Setting it to zero is the caller's part too.
    MatrixArrays matrix();
    void set_matrix_zero();

    /// Makes coarse matrices and smoothers from the finest matrix. False when a column's own block is not
    /// positive definite: then neither is the matrix, and `apply` must not be called before a set-up that
    /// succeeds.
    bool set_up();

    /// x = one cycle for A x = b, from zero; nearly symmetric and, where A is, positive definite.
    void apply(const float* b, float* x);
    /// y = A x; returns x y.
    double product(const float* x, float* y) const;

  private:
    struct Level;
    bool set_up_smoother(Level& level);
    void cycle(std::size_t level, const float* b, float* x);
    void smooth(Level& level, const float* b, float* x);
    double product(Level& level, const float* x, float* y) const;
    void solve(std::size_t level, const float* b, float* x);
    void two_iterations(std::size_t level, const float* b, float* x);
    void solve_coarsest(const float* b, float* x);

    int m_layers;
    const KernelTable& m_table;
    std::vector<std::unique_ptr<Level>> m_levels;  ///< finest first
};

}  // namespace windfall::drying
