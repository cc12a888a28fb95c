// The fibres of the SIMD kernels against the plain element, for both builds and both layer counts.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "drying/element.h"
#include "drying/fibres.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

struct Case {
    const char* name;
    int layers;
    const KernelTable* table;
};

/// What plastic set makes of the drying that the fibres know.
Eigen::Matrix3d set_drying_field(std::size_t quad, int layer) {
    const Eigen::Matrix3d drying = test::uneven_drying(quad, layer);
    return drying * Eigen::Vector3d(1.1, 1 / 1.1, 1).asDiagonal() * drying / drying(0, 0);
}

class FibreKernels : public testing::TestWithParam<Case> {
  protected:
    FibreKernels()
        : m_mesh(test::small_sphere(4, GetParam().layers)),
          m_moduli(layer_moduli(m_mesh.flesh_layers, m_mesh.layers, 10, 50)),
          m_multigrid(m_mesh.brick, m_mesh.layers, *GetParam().table),
          m_fibres(make_fibres(m_mesh, {FibreDirection::Meridional, FibreLayer::Both, 100, 0.4}, m_moduli)) {}

    Elasticity body(const Fibres& fibres) {
        Elasticity result(m_mesh, m_moduli, m_multigrid, {}, fibres);
        result.set_drying(set_drying_field, test::uneven_drying);
        return result;
    }

    /// Of the plain elements.
    struct Sums {
        double energy = 0;
        Eigen::VectorXd force;
        Eigen::MatrixXd hessian;
    };
    Sums sum_of_elements(const AlignedArray<double>& u) const {
        const auto size = static_cast<Eigen::Index>(u.size());
        Sums sums{0, Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
        const ColumnOrder& order = m_multigrid.order();
        for (std::size_t q = 0; q < m_mesh.brick.quads.size(); ++q)
            for (int k = 0; k < m_mesh.layers; ++k) {
                const HexNodes rest = element_nodes(m_mesh, q, k);
                HexNodes now = rest;
                std::array<Eigen::Index, 24> unknowns{};
                for (std::size_t a = 0; a < 8; ++a)
                    for (std::size_t i = 0; i < 3; ++i) {
                        const int level = k + (a < 4 ? 0 : 1);
                        const auto column =
                            static_cast<std::size_t>(order.solver_of_vertex[m_mesh.brick.quads[q][a % 4]]);
                        unknowns[3 * a + i] =
                            level == 0
                                ? -1
                                : static_cast<Eigen::Index>((3 * column + i) * m_mesh.layers) + level - 1;
                        if (level > 0)
                            now[a][static_cast<int>(i)] += u[static_cast<std::size_t>(unknowns[3 * a + i])];
                    }
                const auto layer = static_cast<std::size_t>(k);
                const HexResponse r = hexahedron_response(
                    rest, now,
                    {m_moduli.shear[layer], m_moduli.bulk[layer], set_drying_field(q, k),
                     m_fibres.relaxed(q, test::uneven_drying(q, k)),
                     // Per volume of the drying, which set leaves as it is; this one does not quite.
                     m_fibres.moduli[layer] * test::uneven_drying(q, k).determinant() /
                         set_drying_field(q, k).determinant()});
                sums.energy += r.energy;
                for (std::size_t i = 0; i < 24; ++i) {
                    if (unknowns[i] < 0) continue;
                    sums.force[unknowns[i]] += r.gradient[static_cast<Eigen::Index>(i)];
                    for (std::size_t j = 0; j < 24; ++j)
                        if (unknowns[j] >= 0)
                            sums.hessian(unknowns[i], unknowns[j]) +=
                                r.hessian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                }
            }
        return sums;
    }

    geometry::LayeredMesh m_mesh;
    LayerModuli m_moduli;
    Multigrid m_multigrid;
    Fibres m_fibres;
};

TEST_P(FibreKernels, AgreeWithThePlainElement) {
    Elasticity elasticity = body(m_fibres);
    const AlignedArray<double> u = test::random_displacement(elasticity.size(), 0.004, 1);
    const Sums expected = sum_of_elements(u);
    AlignedArray<double> force(u.size());
    const ElasticEnergy result = elasticity.energy(u, &force);
    EXPECT_EQ(elasticity.energy(u, nullptr).energy, result.energy);
    EXPECT_GT(expected.energy, 1.02 * body({}).energy(u, nullptr).energy);
    EXPECT_NEAR(result.energy, expected.energy, 1e-12 * expected.energy);
    const double largest = expected.force.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < u.size(); ++i)
        ASSERT_NEAR(force[i], expected.force[static_cast<Eigen::Index>(i)], 1e-12 * largest);

    elasticity.assemble(u, 1, 0);
    const double scale = expected.hessian.cwiseAbs().maxCoeff();
    AlignedArray<float> x(u.size());
    AlignedArray<float> y(u.size());
    for (std::size_t column = 0; column < x.size(); column += 7) {
        x.set_zero();
        x[column] = 1;
        m_multigrid.product(x.data(), y.data());
        for (std::size_t row = 0; row < y.size(); ++row)
            ASSERT_NEAR(y[row],
                        expected.hessian(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)),
                        3e-6 * scale)
                << "row " << row << " column " << column;
    }
}

/// Energy, force and a product with the matrix of a state.
struct Answers {
    double energy;
    AlignedArray<double> force;
    AlignedArray<float> product;
    bool operator==(const Answers& other) const {
        return energy == other.energy &&
               std::memcmp(force.data(), other.force.data(), force.size() * sizeof(double)) == 0 &&
               std::memcmp(product.data(), other.product.data(), product.size() * sizeof(float)) == 0;
    }
};

Answers answers(Elasticity& elasticity) {
    const AlignedArray<double> u = test::random_displacement(elasticity.size(), 0.004, 1);
    Answers result{0, AlignedArray<double>(u.size()), AlignedArray<float>(u.size())};
    result.energy = elasticity.energy(u, &result.force).energy;
    AlignedArray<float> x(u.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = static_cast<float>(std::sin(0.37 * static_cast<double>(i)));
    elasticity.assemble(u, 1, 0);
    elasticity.multigrid().product(x.data(), result.product.data());
    return result;
}

TEST_P(FibreKernels, WithoutStiffnessTheBitsAreThoseWithoutFibres) {
    Elasticity bare = body({});
    const Answers without = answers(bare);
    Elasticity fibrous = body(m_fibres);
    EXPECT_FALSE(answers(fibrous) == without);
    m_fibres.moduli.assign(m_fibres.moduli.size(), 0);
    Elasticity limp = body(m_fibres);
    EXPECT_TRUE(answers(limp) == without);
}

TEST_P(FibreKernels, SameBitsOnAnyNumberOfThreads) {
    Elasticity elasticity = body(m_fibres);
    const Answers first = answers(elasticity);
    for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        EXPECT_TRUE(answers(elasticity) == first) << threads;
    }
}

TEST_P(FibreKernels, StressTermsCanBeScaledDown) {
    // Pressed fibres (in swollen flesh) take from the tangent what their stress is; without stress terms they
    // only add to it.
    const auto swollen = [](std::size_t, int) -> Eigen::Matrix3d {
        return 1.2 * Eigen::Matrix3d::Identity();
    };
    Elasticity bare = body({});
    m_fibres.shrinkage = 1;
    Elasticity fibrous = body(m_fibres);
    bare.set_drying(swollen);
    fibrous.set_drying(swollen);
    const AlignedArray<double> zero(bare.size());
    const AlignedArray<double> way = test::random_displacement(bare.size(), 1, 3);
    AlignedArray<float> x(way.size());
    AlignedArray<float> y(way.size());
    std::copy(way.begin(), way.end(), x.begin());
    const auto square = [&](Elasticity& elasticity, double geometric) {
        elasticity.assemble(zero, geometric, 0);
        m_multigrid.product(x.data(), y.data());
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) sum += static_cast<double>(x[i]) * y[i];
        return sum;
    };
    const auto of_fibres = [&](double geometric) {
        return square(fibrous, geometric) - square(bare, geometric);
    };
    EXPECT_GT(of_fibres(0), 0.01 * square(bare, 0));
    EXPECT_LT(of_fibres(1), 0.9 * of_fibres(0));
    EXPECT_NEAR(of_fibres(0.5), (of_fibres(0) + of_fibres(1)) / 2, 1e-3 * of_fibres(0));
}

INSTANTIATE_TEST_SUITE_P(Builds, FibreKernels,
                         testing::Values(Case{"avx2_8", 8, &kernels_avx2(8)},
                                         Case{"avx2_16", 16, &kernels_avx2(16)},
                                         Case{"best_8", 8, &kernels(8)}, Case{"best_16", 16, &kernels(16)}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

}  // namespace
}  // namespace windfall::drying
