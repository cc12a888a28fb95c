// The column kernels against dense matrices: coarse matrices, transfer, block inverses and sweeps.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "drying/multigrid.h"
#include "support/plain_elements.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

/// A level's arrays with a random symmetric positive definite matrix in them, and the same matrix densely.
struct RandomLevel {
    geometry::BrickSurface brick;
    ColumnOrder order;
    int layers;
    AlignedArray<float> diagonal, lower;
    Eigen::MatrixXd dense;

    RandomLevel(geometry::Lattice cells, int layer_count)
        : brick(geometry::make_brick_surface(cells)),
          order(make_column_order(brick)),
          layers(layer_count),
          diagonal(static_cast<std::size_t>(order.column_count()) * 18 * layers),
          lower(order.lower_column.size() * 27 * layers) {
        const auto noise = test::random_displacement(lower.size() + diagonal.size(), 1, 11);
        for (std::size_t i = 0; i < lower.size(); ++i) lower[i] = static_cast<float>(noise[i]);
        for (std::size_t i = 0; i < diagonal.size(); ++i)
            diagonal[i] = static_cast<float>(noise[lower.size() + i]);
        tidy();
        dense = to_dense();
    }

    MatrixArrays matrix() {
        return {order.lower_begin.data(), order.lower_column.data(), diagonal.data(), lower.data()};
    }
    Eigen::Index size() const { return static_cast<Eigen::Index>(order.column_count()) * 3 * layers; }
    Eigen::Index unknown(std::int32_t column, int axis, int layer) const {
        return (3 * static_cast<Eigen::Index>(column) + axis) * layers + layer;
    }

    /// Couplings over the ends of a column are zero, a column's own block is symmetric and dominant.
    void tidy() {
        const auto at = [this](AlignedArray<float>& a, std::size_t block, int entry, int layer) -> float& {
            return a[(block + static_cast<std::size_t>(entry)) * layers + layer];
        };
        for (std::size_t e = 0; e < order.lower_column.size(); ++e)
            for (int i = 0; i < 9; ++i) {
                at(lower, 27 * e, i, 0) = 0;
                at(lower, 27 * e, 18 + i, layers - 1) = 0;
            }
        for (std::int32_t c = 0; c < order.column_count(); ++c) {
            const std::size_t block = static_cast<std::size_t>(c) * 18;
            for (int i = 0; i < 9; ++i) at(diagonal, block, i, 0) = 0;
            for (int k = 0; k < layers; ++k)
                for (int i = 0; i < 3; ++i) {
                    for (int j = 0; j < i; ++j)
                        at(diagonal, block, 9 + 3 * i + j, k) = at(diagonal, block, 9 + 3 * j + i, k);
                    at(diagonal, block, 9 + 4 * i, k) += 60;
                }
        }
    }

    Eigen::MatrixXd to_dense() const {
        Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(), size());
        const auto put = [&](std::int32_t row, std::int32_t column, const float* block, int parts) {
            for (int d = 0; d < parts; ++d)
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        for (int k = 0; k < layers; ++k) {
                            const int l = k + d - 1;
                            if (l < 0 || l >= layers) continue;
                            const double value = block[(9 * d + 3 * i + j) * layers + k];
                            result(unknown(row, i, k), unknown(column, j, l)) = value;
                            result(unknown(column, j, l), unknown(row, i, k)) = value;
                        }
        };
        for (std::int32_t v = 0; v < order.column_count(); ++v) {
            put(v, v, diagonal.data() + static_cast<std::size_t>(v) * 18 * layers, 2);
            for (std::int32_t e = order.lower_begin[v]; e < order.lower_begin[v + 1]; ++e)
                put(v, order.lower_column[e], lower.data() + static_cast<std::size_t>(e) * 27 * layers, 3);
        }
        return result;
    }
};

AlignedArray<float> random_floats(Eigen::Index size, std::uint64_t seed) {
    const auto values = test::random_displacement(static_cast<std::size_t>(size), 1, seed);
    AlignedArray<float> result(values.size());
    std::copy(values.begin(), values.end(), result.begin());
    return result;
}

Eigen::VectorXd to_eigen(const AlignedArray<float>& a) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i) result[static_cast<Eigen::Index>(i)] = a[i];
    return result;
}

class ColumnKernels : public testing::TestWithParam<test::KernelBuild> {
  protected:
    const KernelTable& m_table = *GetParam().table;
};

TEST_P(ColumnKernels, ProductIsThatOfTheSymmetricMatrix) {
    RandomLevel level({3, 4, 2}, GetParam().layers);
    const AlignedArray<float> x = random_floats(level.size(), 1);
    AlignedArray<float> y(x.size());
    const std::int32_t columns = level.order.column_count();
    double inner = m_table.product(level.matrix(), x.data(), y.data(), {0, columns / 3});
    inner += m_table.product(level.matrix(), x.data(), y.data(), {columns / 3, columns});
    const Eigen::VectorXd right = to_eigen(x);
    const Eigen::VectorXd expected = level.dense * right;
    EXPECT_LT((to_eigen(y) - expected).norm(), 1e-5 * expected.norm());
    EXPECT_NEAR(inner, right.dot(expected), 1e-6 * right.norm() * expected.norm());
}

/// The smoother of a level, with the scale of lower blocks that the tests use.
struct Smoother {
    AlignedArray<std::uint16_t> packed;
    AlignedArray<float> inverse_factor;

    explicit Smoother(const RandomLevel& level)
        : packed(static_cast<std::size_t>(level.order.column_count()) * inverse_vectors(level.layers) *
                     level.layers +
                 level.lower.size()),
          inverse_factor(level.order.column_count()) {}
    SmootherArrays arrays() { return {packed.data(), 64, inverse_factor.data()}; }
};

/// Forward sweep over a matrix without couplings of columns: each column's inverse times b.
TEST_P(ColumnKernels, InvertedBlocksAreInverses) {
    RandomLevel level({2, 2, 2}, GetParam().layers);
    level.lower.set_zero();
    const int layers = GetParam().layers;
    const std::size_t block_size = 3 * static_cast<std::size_t>(layers);
    // Columns of other magnitudes, and in some of them layers like those of a thin stiff skin: a thousand
    // times as stiff, the coupling to the next layer nearly as large as the layers' own blocks.
    for (std::int32_t c = 0; c < level.order.column_count(); ++c) {
        float* d = level.diagonal.data() + static_cast<std::size_t>(c) * 18 * layers;
        const float magnitude = std::exp2(static_cast<float>(c % 7 * 4 - 12));
        for (int i = 0; i < 18 * layers; ++i) d[i] *= magnitude;
        for (int k = layers / 2; c % 2 == 1 && k < layers; ++k)
            for (int i = 0; i < 3; ++i) {
                const float stiff = 60e3F * magnitude;
                d[4 * i * layers + k] -= stiff;
                d[(9 + 4 * i) * layers + k] += stiff;
                d[(9 + 4 * i) * layers + k - 1] += stiff;
            }
    }
    const Eigen::MatrixXd dense = level.to_dense();
    Smoother smoother(level);
    const Range all = {0, level.order.column_count()};
    ASSERT_TRUE(m_table.pack_inverses(level.matrix(), smoother.arrays(), all));
    m_table.pack_lower(level.matrix(), smoother.arrays(), all);
    AlignedArray<float> b(static_cast<std::size_t>(level.size()));
    AlignedArray<float> x(b.size());
    AlignedArray<float> residual(b.size());
    for (std::size_t unknown = 0; unknown < block_size; ++unknown) {
        for (std::int32_t c = 0; c < all.end; ++c) b[c * block_size + unknown] = 1;
        m_table.sweep_forward(level.matrix(), smoother.arrays(), b.data(), x.data(), residual.data(), all);
        for (std::int32_t c = 0; c < all.end; ++c) {
            const auto start = static_cast<Eigen::Index>(c * block_size);
            const auto size = static_cast<Eigen::Index>(block_size);
            const Eigen::MatrixXd exact = dense.block(start, start, size, size).inverse();
            const Eigen::VectorXd column = to_eigen(x).segment(start, size);
            const Eigen::VectorXd expected = exact.col(static_cast<Eigen::Index>(unknown));
            // Half precision: 2^-11 of each factor, and entries of one vector share a column's scale.
            ASSERT_LT((column - expected).norm(), 1.5e-3 * expected.norm()) << c << " " << unknown;
            b[c * block_size + unknown] = 0;
        }
    }
}

TEST_P(ColumnKernels, IndefiniteBlocksAreRefused) {
    RandomLevel level({2, 2, 2}, GetParam().layers);
    const int layers = GetParam().layers;
    Smoother smoother(level);
    const Range all = {0, level.order.column_count()};
    for (const std::int32_t column : {0, 17, all.end - 1})
        for (int k = 0; k < layers; ++k) {
            float& entry = level.diagonal[(static_cast<std::size_t>(column) * 18 + 13) * layers + k];
            const float before = entry;
            entry = -1;
            EXPECT_FALSE(m_table.pack_inverses(level.matrix(), smoother.arrays(), all)) << column << " " << k;
            entry = before;
        }
    EXPECT_TRUE(m_table.pack_inverses(level.matrix(), smoother.arrays(), all));
}

TEST_P(ColumnKernels, SweepsAreSymmetricGaussSeidel) {
    RandomLevel level({3, 2, 2}, GetParam().layers);
    const int layers = GetParam().layers;
    const Range all = {0, level.order.column_count()};
    Smoother made(level);
    const SmootherArrays smoother = made.arrays();
    ASSERT_TRUE(m_table.pack_inverses(level.matrix(), smoother, all));
    m_table.pack_lower(level.matrix(), smoother, all);
    const AlignedArray<float> b = random_floats(level.size(), 2);
    AlignedArray<float> x(b.size());
    AlignedArray<float> residual(b.size());
    m_table.sweep_forward(level.matrix(), smoother, b.data(), x.data(), residual.data(), all);

    // (L + D) x = b; what is left over is -U x.
    const int block = 3 * layers;
    Eigen::MatrixXd lower_part = level.dense;
    for (std::int32_t c = 0; c < all.end; ++c)
        lower_part.block(c * block, (c + 1) * block, block, level.size() - (c + 1) * block).setZero();
    const Eigen::VectorXd forward = lower_part.partialPivLu().solve(to_eigen(b));
    EXPECT_LT((to_eigen(x) - forward).norm(), 2e-3 * forward.norm());
    const Eigen::VectorXd left = (lower_part - level.dense) * forward;
    EXPECT_LT((to_eigen(residual) / 64 - left).norm(), 5e-3 * left.norm());

    residual.set_zero();
    m_table.sweep_backward(level.matrix(), smoother, b.data(), x.data(), residual.data(), all);
    const Eigen::MatrixXd upper_part = lower_part.transpose();
    const Eigen::VectorXd backward =
        upper_part.partialPivLu().solve(to_eigen(b) - (level.dense - upper_part) * forward);
    EXPECT_LT((to_eigen(x) - backward).norm(), 3e-3 * backward.norm());
}

TEST_P(ColumnKernels, CoarseMatrixIsGalerkins) {
    RandomLevel fine({4, 4, 4}, GetParam().layers);
    RandomLevel coarse(geometry::coarser(fine.brick.cells), GetParam().layers);
    const int layers = GetParam().layers;
    const auto parents = geometry::brick_parents(fine.brick, coarse.brick);
    Eigen::MatrixXd prolongation = Eigen::MatrixXd::Zero(fine.size(), coarse.size());
    std::vector<std::array<std::int32_t, 4>> parent(parents.size());
    std::vector<std::int32_t> parent_count(parents.size());
    std::vector<std::int32_t> child_begin(1, 0);
    std::vector<std::int32_t> child_column;
    std::vector<float> child_weight;
    for (std::int32_t v = 0; v < fine.order.column_count(); ++v) {
        const auto& own = parents[fine.order.vertex_of_solver[v]];
        parent_count[v] = own.count;
        for (int p = 0; p < own.count; ++p) {
            parent[v][p] = coarse.order.solver_of_vertex[own.vertex[p]];
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < layers; ++k)
                    prolongation(fine.unknown(v, i, k), coarse.unknown(parent[v][p], i, k)) = 1.0 / own.count;
        }
    }
    for (std::int32_t c = 0; c < coarse.order.column_count(); ++c) {
        for (std::int32_t v = 0; v < fine.order.column_count(); ++v)
            for (int p = 0; p < parent_count[v]; ++p)
                if (parent[v][p] == c) {
                    child_column.push_back(v);
                    child_weight.push_back(1.0F / static_cast<float>(parent_count[v]));
                }
        child_begin.push_back(static_cast<std::int32_t>(child_column.size()));
    }
    const TransferArrays transfer = {child_begin.data(), child_column.data(), child_weight.data(),
                                     reinterpret_cast<const std::int32_t(*)[4]>(parent.data()),
                                     parent_count.data()};
    const UpperArrays upper = {fine.order.upper_begin.data(), fine.order.upper_column.data(),
                               fine.order.upper_entry.data()};
    m_table.galerkin(fine.matrix(), upper, transfer, coarse.matrix(), {0, coarse.order.column_count()});
    const Eigen::SparseMatrix<double> sparse = prolongation.sparseView();
    const Eigen::MatrixXd half = fine.dense * sparse;
    const Eigen::MatrixXd expected = sparse.transpose() * half;
    EXPECT_LT((coarse.to_dense() - expected).norm(), 1e-5 * expected.norm());

    const AlignedArray<float> residual = random_floats(fine.size(), 3);
    AlignedArray<float> coarse_b(static_cast<std::size_t>(coarse.size()));
    m_table.restrict_residual(transfer, 0.5F, residual.data(), coarse_b.data(),
                              {0, coarse.order.column_count()});
    EXPECT_LT((to_eigen(coarse_b) - 0.5 * prolongation.transpose() * to_eigen(residual)).norm(), 1e-4);

    const AlignedArray<float> coarse_x = random_floats(coarse.size(), 4);
    AlignedArray<float> x = random_floats(fine.size(), 5);
    const Eigen::VectorXd prolonged = to_eigen(x) + prolongation * to_eigen(coarse_x);
    AlignedArray<float> cleared = residual;
    m_table.prolong(transfer, coarse_x.data(), x.data(), cleared.data(), {0, fine.order.column_count()});
    EXPECT_LT((to_eigen(x) - prolonged).norm(), 1e-4);
    EXPECT_EQ(to_eigen(cleared).norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(Builds, ColumnKernels, testing::ValuesIn(test::kernel_builds()), test::name_of);

}  // namespace
}  // namespace windfall::drying
