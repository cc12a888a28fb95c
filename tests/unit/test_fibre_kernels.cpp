// The fibres of the SIMD kernels against the plain element, for both builds and both layer counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "drying/fibres.h"
#include "support/plain_elements.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

/// What plastic set makes of the drying that the fibres know.
Eigen::Matrix3d set_drying_field(std::size_t quad, int layer) {
    const Eigen::Matrix3d drying = test::uneven_drying(quad, layer);
    return drying * Eigen::Vector3d(1.1, 1 / 1.1, 1).asDiagonal() * drying / drying(0, 0);
}

class FibreKernels : public testing::TestWithParam<test::KernelBuild> {
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

    HexMaterial material(std::size_t quad, int layer) const {
        const Eigen::Matrix3d drying = test::uneven_drying(quad, layer);
        const Eigen::Matrix3d set = set_drying_field(quad, layer);
        // Per volume of the drying, which set leaves as it is; this one does not quite.
        const double modulus = m_fibres.moduli[layer] * drying.determinant() / set.determinant();
        return {m_moduli.shear[layer], m_moduli.bulk[layer], set, m_fibres.relaxed(quad, drying), modulus};
    }

    geometry::LayeredMesh m_mesh;
    LayerModuli m_moduli;
    Multigrid m_multigrid;
    Fibres m_fibres;
};

TEST_P(FibreKernels, AgreeWithThePlainElement) {
    Elasticity elasticity = body(m_fibres);
    const AlignedArray<double> u = test::random_displacement(elasticity.size(), 0.004, 1);
    const test::BodyResponse expected =
        test::plain_response(m_mesh, m_multigrid.order(), u,
                             [this](std::size_t quad, int layer) { return material(quad, layer); });
    EXPECT_GT(expected.energy, 1.02 * body({}).energy(u, nullptr).energy);
    test::expect_energy_and_force(elasticity, u, expected);
    test::expect_tangent(elasticity, u, expected);
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

INSTANTIATE_TEST_SUITE_P(Builds, FibreKernels, testing::ValuesIn(test::kernel_builds()), test::name_of);

}  // namespace
}  // namespace windfall::drying
