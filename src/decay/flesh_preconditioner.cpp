#include "decay/flesh_preconditioner.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>

#include "core/error.h"

namespace windfall::decay {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Pairs of vertices of a tetrahedron, each with itself first: 4 + 6 entries of the lower triangle.
constexpr std::array<std::array<int, 2>, 10> kVertexPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

}  // namespace

struct FleshPreconditioner::Parts {
    SparseMatrix matrix;                                   ///< lower triangle
    std::vector<std::array<std::int32_t, 10>> entries;     ///< per element: places in the matrix's values
    std::vector<std::array<float, 10>> gradient_products;  ///< per element: grad N_i . grad N_j
    std::vector<std::int32_t> diagonal_entries;
    Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt;

    // The factor in single precision: columns of L below the diagonal.
    std::vector<std::int32_t> column_begin, rows, place;
    std::vector<float> values, inverse_diagonal;
    mutable std::vector<Eigen::Vector4f> work;
};

FleshPreconditioner::FleshPreconditioner(FleshPreconditioner&&) noexcept = default;
FleshPreconditioner& FleshPreconditioner::operator=(FleshPreconditioner&&) noexcept = default;
FleshPreconditioner::~FleshPreconditioner() = default;

FleshPreconditioner::FleshPreconditioner(const FleshMesh& mesh) : m_parts(std::make_unique<Parts>()) {
    auto& p = *m_parts;
    const auto n = static_cast<int>(mesh.nodes.size());
    std::vector<Eigen::Triplet<double>> triplets;
    for (int i = 0; i < n; ++i) triplets.emplace_back(i, i, 1.0);
    for (const auto& [a, b] : edges_of(mesh.tetrahedra)) triplets.emplace_back(b, a, 1.0);
    p.matrix.resize(n, n);
    p.matrix.setFromTriplets(triplets.begin(), triplets.end());
    p.matrix.makeCompressed();
    const auto entry_of = [&p](int i, int j) {
        const int row = std::max(i, j);
        const int column = std::min(i, j);
        const int* begin = p.matrix.innerIndexPtr() + p.matrix.outerIndexPtr()[column];
        const int* end = p.matrix.innerIndexPtr() + p.matrix.outerIndexPtr()[column + 1];
        return static_cast<std::int32_t>(std::lower_bound(begin, end, row) - p.matrix.innerIndexPtr());
    };
    for (int i = 0; i < n; ++i) p.diagonal_entries.push_back(entry_of(i, i));
    for (const Tetrahedron& t : mesh.tetrahedra) {
        Eigen::Matrix3d D;
        for (int k = 0; k < 3; ++k) D.col(k) = mesh.nodes[t[k + 1]] - mesh.nodes[t[0]];
        Eigen::Matrix<double, 4, 3> gradients;
        gradients.bottomRows<3>() = D.inverse();
        gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
        auto& entries = p.entries.emplace_back();
        auto& products = p.gradient_products.emplace_back();
        for (std::size_t k = 0; k < kVertexPairs.size(); ++k) {
            const auto [a, b] = kVertexPairs[k];
            entries[k] = entry_of(t[a], t[b]);
            products[k] = static_cast<float>(gradients.row(a).dot(gradients.row(b)));
        }
    }
    p.ldlt.analyzePattern(p.matrix);
}

void FleshPreconditioner::factorise(const std::vector<float>& weights, const std::vector<float>& diagonal) {
    auto& p = *m_parts;
    double* values = p.matrix.valuePtr();
    std::fill_n(values, p.matrix.nonZeros(), 0.0);
    for (std::size_t e = 0; e < p.entries.size(); ++e)
        for (std::size_t k = 0; k < kVertexPairs.size(); ++k)
            values[p.entries[e][k]] += static_cast<double>(weights[e]) * p.gradient_products[e][k];
    for (std::size_t i = 0; i < p.diagonal_entries.size(); ++i) values[p.diagonal_entries[i]] += diagonal[i];
    p.ldlt.factorize(p.matrix);
    if (p.ldlt.info() != Eigen::Success || !p.ldlt.vectorD().allFinite() || p.ldlt.vectorD().minCoeff() <= 0)
        throw RunError("the stiffness of the flesh is not positive: its material has a zero or a NaN in it");

    const SparseMatrix& L = p.ldlt.matrixL().nestedExpression();
    const auto n = static_cast<int>(L.cols());
    p.column_begin.assign(1, 0);
    p.rows.clear();
    p.values.clear();
    for (int j = 0; j < n; ++j) {
        for (SparseMatrix::InnerIterator it(L, j); it; ++it)
            if (it.row() != j) {
                p.rows.push_back(it.row());
                p.values.push_back(static_cast<float>(it.value()));
            }
        p.column_begin.push_back(static_cast<std::int32_t>(p.rows.size()));
    }
    p.inverse_diagonal.resize(n);
    p.place.resize(n);
    for (int i = 0; i < n; ++i) {
        p.inverse_diagonal[i] = static_cast<float>(1 / p.ldlt.vectorD()[i]);
        p.place[i] = p.ldlt.permutationP().indices()[i];
    }
    p.work.resize(n);
}

void FleshPreconditioner::solve(const std::vector<Eigen::Vector4f>& right,
                                std::vector<Eigen::Vector4f>& result) const {
    const auto& p = *m_parts;
    auto& w = p.work;
    const auto n = static_cast<std::int32_t>(p.place.size());
    for (std::int32_t i = 0; i < n; ++i) w[p.place[i]] = right[i];
    for (std::int32_t j = 0; j < n; ++j) {
        const Eigen::Vector4f known = w[j];
        for (std::int32_t k = p.column_begin[j]; k < p.column_begin[j + 1]; ++k)
            w[p.rows[k]] -= p.values[k] * known;
    }
    for (std::int32_t j = n - 1; j >= 0; --j) {
        Eigen::Vector4f sum = p.inverse_diagonal[j] * w[j];
        for (std::int32_t k = p.column_begin[j]; k < p.column_begin[j + 1]; ++k)
            sum -= p.values[k] * w[p.rows[k]];
        w[j] = sum;
    }
    result.resize(n);
    for (std::int32_t i = 0; i < n; ++i) result[i] = w[p.place[i]];
}

}  // namespace windfall::decay
