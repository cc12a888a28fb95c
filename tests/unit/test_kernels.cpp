// The SIMD kernels against the plain element and against dense matrices, for both builds and both layer
// counts.
#include "drying/kernels/kernels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plain_elements.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

class Kernels : public testing::TestWithParam<test::KernelBuild> {
  protected:
    Kernels()
        : m_mesh(test::small_sphere(4, GetParam().layers)),
          m_moduli(layer_moduli(m_mesh.flesh_layers, m_mesh.layers, 10, 50)),
          m_multigrid(m_mesh.brick, m_mesh.layers, *GetParam().table),
          m_elasticity(m_mesh, m_moduli, m_multigrid),
          m_displacement(test::random_displacement(m_elasticity.size(), 0.004, 1)) {
        m_elasticity.set_drying(test::uneven_drying);
    }

    HexMaterial material(std::size_t quad, int layer) const {
        return {m_moduli.shear[layer], m_moduli.bulk[layer], test::uneven_drying(quad, layer)};
    }

    test::BodyResponse plain() const {
        return test::plain_response(m_mesh, m_multigrid.order(), m_displacement,
                                    [this](std::size_t quad, int layer) { return material(quad, layer); });
    }

    geometry::LayeredMesh m_mesh;
    LayerModuli m_moduli;
    Multigrid m_multigrid;
    Elasticity m_elasticity;
    AlignedArray<double> m_displacement;
};

TEST_P(Kernels, EnergyAndForceAgreeWithThePlainElement) {
    const test::BodyResponse expected = plain();
    EXPECT_GT(expected.energy, 0.01);
    test::expect_energy_and_force(m_elasticity, m_displacement, expected);
}

TEST_P(Kernels, TangentAgreesWithThePlainElement) {
    test::expect_tangent(m_elasticity, m_displacement, plain());
}

TEST_P(Kernels, VolumesAgreeWithThePlainElement) {
    const AlignedArray<double> volumes = m_elasticity.volumes(m_displacement);
    const ColumnOrder& order = m_multigrid.order();
    const geometry::LayeredMesh now = test::displaced(m_mesh, order, m_displacement);
    const auto layers = static_cast<std::size_t>(m_mesh.layers);
    for (std::size_t q = 0; q < order.quads.size(); ++q)
        for (std::size_t k = 0; k < layers; ++k) {
            const auto quad = static_cast<std::size_t>(order.brick_quad[q]);
            const auto layer = static_cast<int>(k);
            const HexState state = hexahedron_state(element_nodes(m_mesh, quad, layer),
                                                    element_nodes(now, quad, layer), HexMaterial{});
            const double* entry = volumes.data() + q * kVolumeEntries * layers + k;
            ASSERT_NEAR(entry[0], state.rest_volume, 1e-13);
            ASSERT_NEAR(entry[layers], state.volume, 1e-13);
            ASSERT_NEAR(entry[2 * layers], state.smallest_elastic, 1e-11);
            ASSERT_NEAR(entry[3 * layers], state.largest_elastic, 1e-11);
            ASSERT_LT(state.smallest_elastic, state.largest_elastic);
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

INSTANTIATE_TEST_SUITE_P(Builds, Kernels, testing::ValuesIn(test::kernel_builds()), test::name_of);

}  // namespace
}  // namespace windfall::drying
