// The SIMD kernels against the plain element and against dense matrices, for both builds and both layer
// counts.
#include "drying/kernels/kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "drying/element.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

struct Case {
    const char* name;
    int layers;
    const KernelTable* table;
};

class Kernels : public testing::TestWithParam<Case> {
  protected:
    Kernels()
        : m_mesh(test::small_sphere(4, GetParam().layers)),
          m_moduli(layer_moduli(m_mesh.flesh_layers, m_mesh.layers, 10, 50)),
          m_multigrid(m_mesh.brick, m_mesh.layers, *GetParam().table),
          m_elasticity(m_mesh, m_moduli, m_multigrid),
          m_displacement(test::random_displacement(m_elasticity.size(), 0.004, 1)) {
        m_elasticity.set_drying(test::uneven_drying);
    }

    std::size_t unknown(std::int32_t vertex, int level, int axis) const {
        return (3 * static_cast<std::size_t>(m_multigrid.order().solver_of_vertex[vertex]) + axis) *
                   m_mesh.layers +
               (level - 1);
    }

    /// Calls body(response, unknowns of the element's 24 components; -1 on the stone).
    template <class Body>
    void for_elements(Body body) const {
        for (std::size_t q = 0; q < m_mesh.brick.quads.size(); ++q)
            for (int k = 0; k < m_mesh.layers; ++k) {
                const HexNodes rest = element_nodes(m_mesh, q, k);
                HexNodes now = rest;
                std::array<std::ptrdiff_t, 24> unknowns{};
                for (int a = 0; a < 8; ++a)
                    for (int i = 0; i < 3; ++i) {
                        const int level = k + (a < 4 ? 0 : 1);
                        if (level == 0) {
                            unknowns[3 * a + i] = -1;
                            continue;
                        }
                        const std::size_t u = unknown(m_mesh.brick.quads[q][a % 4], level, i);
                        unknowns[3 * a + i] = static_cast<std::ptrdiff_t>(u);
                        now[a][i] += m_displacement[u];
                    }
                body(hexahedron_response(rest, now,
                                         {m_moduli.shear[k], m_moduli.bulk[k], test::uneven_drying(q, k)}),
                     unknowns);
            }
    }

    Eigen::MatrixXd dense_hessian() const {
        const auto size = static_cast<Eigen::Index>(m_elasticity.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
        for_elements([&](const HexResponse& r, const auto& unknowns) {
            for (int i = 0; i < 24; ++i)
                for (int j = 0; j < 24; ++j)
                    if (unknowns[i] >= 0 && unknowns[j] >= 0)
                        matrix(unknowns[i], unknowns[j]) += r.hessian(i, j);
        });
        return matrix;
    }

    geometry::LayeredMesh m_mesh;
    LayerModuli m_moduli;
    Multigrid m_multigrid;
    Elasticity m_elasticity;
    AlignedArray<double> m_displacement;
};

TEST_P(Kernels, EnergyAndForceAgreeWithThePlainElement) {
    AlignedArray<double> force(m_elasticity.size());
    const ElasticEnergy result = m_elasticity.energy(m_displacement, &force);
    ASSERT_TRUE(result.valid());
    double energy = 0;
    std::vector<double> expected(m_elasticity.size(), 0.0);
    double largest = 0;
    for_elements([&](const HexResponse& r, const auto& unknowns) {
        energy += r.energy;
        for (int i = 0; i < 24; ++i)
            if (unknowns[i] >= 0) expected[unknowns[i]] += r.gradient[i];
    });
    for (const double f : expected) largest = std::max(largest, std::abs(f));
    EXPECT_GT(energy, 0.01);
    EXPECT_NEAR(result.energy, energy, 1e-12 * energy);
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(force[i], expected[i], 1e-12 * largest);
    EXPECT_EQ(m_elasticity.energy(m_displacement, nullptr).energy, result.energy);
}

TEST_P(Kernels, TangentAgreesWithThePlainElement) {
    m_elasticity.assemble(m_displacement, 1, 0);
    const Eigen::MatrixXd expected = dense_hessian();
    const double scale = expected.cwiseAbs().maxCoeff();
    AlignedArray<float> x(m_elasticity.size());
    AlignedArray<float> y(m_elasticity.size());
    for (std::size_t column = 0; column < x.size(); column += 7) {
        x.set_zero();
        x[column] = 1;
        m_multigrid.product(x.data(), y.data());
        for (std::size_t row = 0; row < y.size(); ++row)
            ASSERT_NEAR(y[row], expected(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)),
                        3e-6 * scale)
                << "row " << row << " column " << column;
    }
}

TEST_P(Kernels, MassIsAddedToTheDiagonalOnly) {
    AlignedArray<float> x(m_elasticity.size());
    AlignedArray<float> without(m_elasticity.size());
    AlignedArray<float> with(m_elasticity.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = static_cast<float>(std::sin(0.37 * static_cast<double>(i)));
    m_elasticity.assemble(m_displacement, 1, 0);
    m_multigrid.product(x.data(), without.data());
    m_elasticity.assemble(m_displacement, 1, 1000);
    m_multigrid.product(x.data(), with.data());
    const auto layers = static_cast<std::size_t>(m_mesh.layers);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double mass = m_elasticity.mass()[i / (3 * layers) * layers + i % layers];
        ASSERT_NEAR(with[i] - without[i], 1000 * mass * x[i], 1e-3);
    }
}

TEST_P(Kernels, InvertedElementsAreNoticed) {
    m_displacement[m_mesh.layers - 1] = 3;
    EXPECT_FALSE(m_elasticity.energy(m_displacement, nullptr).valid());
}

TEST_P(Kernels, LogarithmIsAccurateFarFromOne) {
    // Free shrinking by theta costs nothing in the body as a whole only if ln(det F / det Fd) is right at
    // every size.
    for (const double theta : {0.05, 0.3, 0.7, 1.0, 1.5, 4.0}) {
        m_elasticity.set_drying(
            [theta](std::size_t, int) -> Eigen::Matrix3d { return theta * Eigen::Matrix3d::Identity(); });
        AlignedArray<double> zero(m_elasticity.size());
        const double energy = m_elasticity.energy(zero, nullptr).energy;
        double expected = 0;
        for (std::size_t q = 0; q < m_mesh.brick.quads.size(); ++q)
            for (int k = 0; k < m_mesh.layers; ++k) {
                const HexNodes rest = element_nodes(m_mesh, q, k);
                expected += hexahedron_response(
                                rest, rest,
                                {m_moduli.shear[k], m_moduli.bulk[k], theta * Eigen::Matrix3d::Identity()})
                                .energy;
            }
        EXPECT_NEAR(energy, expected, 1e-12 * std::max(1.0, expected)) << theta;
    }
}

std::vector<Case> cases() {
    std::vector<Case> list = {{"avx2_8", 8, &kernels_avx2(8)}, {"avx2_16", 16, &kernels_avx2(16)}};
    // The same tables again where the machine has no AVX-512.
    list.push_back({"best_8", 8, &kernels(8)});
    list.push_back({"best_16", 16, &kernels(16)});
    return list;
}

INSTANTIATE_TEST_SUITE_P(Builds, Kernels, testing::ValuesIn(cases()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

}  // namespace
}  // namespace windfall::drying
