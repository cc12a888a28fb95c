#pragma once
// The plain hexahedra of a body, summed: what the SIMD kernels are held against.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

#include "core/random.h"
#include "drying/elasticity.h"
#include "drying/element.h"

namespace windfall::test {

/// A unit cube whose corners are each moved by up to half of `amplitude` along each axis.
inline drying::HexNodes bent_hexahedron(double amplitude, std::uint64_t seed) {
    constexpr double kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    drying::HexNodes nodes;
    for (std::size_t a = 0; a < 8; ++a) {
        const auto u = random_uniform4(seed, RandomPurpose::LanczosStart, a);
        nodes[a] = Eigen::Vector3d(kCorners[a % 4][0], kCorners[a % 4][1], a < 4 ? 0 : 1);
        for (int i = 0; i < 3; ++i) nodes[a][i] += amplitude * (u[static_cast<std::size_t>(i)] - 0.5);
    }
    return nodes;
}

/// A build of the kernels.
struct KernelBuild {
    const char* name;
    int layers;
    const drying::KernelTable* table;
};

/// Both builds for both layer counts; the best is AVX2 again where the machine has no AVX-512.
inline std::vector<KernelBuild> kernel_builds() {
    return {{"avx2_8", 8, &drying::kernels_avx2(8)},
            {"avx2_16", 16, &drying::kernels_avx2(16)},
            {"best_8", 8, &drying::kernels(8)},
            {"best_16", 16, &drying::kernels(16)}};
}

inline std::string name_of(const testing::TestParamInfo<KernelBuild>& info) { return info.param.name; }

/// The mesh with its nodes moved by a displacement in the solver's order.
inline geometry::LayeredMesh displaced(geometry::LayeredMesh mesh, const drying::ColumnOrder& order,
                                       const AlignedArray<double>& u) {
    const auto layers = static_cast<std::size_t>(mesh.layers);
    for (std::size_t c = 0; c < mesh.columns(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < layers; ++k)
                mesh.nodes[order.vertex_of_solver[c] * layers + k][static_cast<int>(i)] +=
                    u[(3 * c + i) * layers + k];
    return mesh;
}

/// Unknowns of an element's 24 components in the order of the solver; -1 on the stone.
using ElementUnknowns = std::array<Eigen::Index, 24>;

/// Calls visit(response, unknowns) for every element at the displacement `u`; material(quad, layer) is that
/// of an element.
template <class Material, class Visit>
void visit_plain_elements(const geometry::LayeredMesh& mesh, const drying::ColumnOrder& order,
                          const AlignedArray<double>& u, const Material& material, const Visit& visit) {
    const auto visit_one = [&](std::size_t q, int k) {
        const drying::HexNodes rest = drying::element_nodes(mesh, q, k);
        drying::HexNodes now = rest;
        ElementUnknowns unknowns{};
        for (std::size_t a = 0; a < 8; ++a) {
            const auto column = static_cast<std::size_t>(order.solver_of_vertex[mesh.brick.quads[q][a % 4]]);
            const int level = k + (a < 4 ? 0 : 1);
            for (std::size_t i = 0; i < 3; ++i) {
                Eigen::Index& unknown = unknowns[3 * a + i];
                unknown =
                    level == 0 ? -1 : static_cast<Eigen::Index>((3 * column + i) * mesh.layers) + level - 1;
                if (level > 0) now[a][static_cast<int>(i)] += u[static_cast<std::size_t>(unknown)];
            }
        }
        visit(drying::hexahedron_response(rest, now, material(q, k)), unknowns);
    };
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q)
        for (int k = 0; k < mesh.layers; ++k) visit_one(q, k);
}

/// Energy of a body and its derivatives with respect to the unknowns.
struct BodyResponse {
    double energy = 0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
};

template <class Material>
BodyResponse plain_response(const geometry::LayeredMesh& mesh, const drying::ColumnOrder& order,
                            const AlignedArray<double>& u, const Material& material) {
    const auto size = static_cast<Eigen::Index>(u.size());
    BodyResponse sums{0, Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
    const auto add = [&](const drying::HexResponse& response, const ElementUnknowns& unknowns) {
        sums.energy += response.energy;
        for (int i = 0; i < 24; ++i) {
            if (unknowns[i] < 0) continue;
            sums.gradient[unknowns[i]] += response.gradient[i];
            for (int j = 0; j < 24; ++j)
                if (unknowns[j] >= 0) sums.hessian(unknowns[i], unknowns[j]) += response.hessian(i, j);
        }
    };
    visit_plain_elements(mesh, order, u, material, add);
    return sums;
}

/// Energy and force of the kernels against those of the plain elements, to rounding.
inline void expect_energy_and_force(const drying::Elasticity& elasticity, const AlignedArray<double>& u,
                                    const BodyResponse& expected) {
    AlignedArray<double> force(u.size());
    const drying::ElasticEnergy result = elasticity.energy(u, &force);
    ASSERT_TRUE(result.valid());
    EXPECT_NEAR(result.energy, expected.energy, 1e-12 * expected.energy);
    EXPECT_EQ(elasticity.energy(u, nullptr).energy, result.energy);
    const double largest = expected.gradient.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < u.size(); ++i)
        ASSERT_NEAR(force[i], expected.gradient[static_cast<Eigen::Index>(i)], 1e-12 * largest);
}

/// Every seventh column of the tangent against that of the plain elements, to single precision.
inline void expect_tangent(drying::Elasticity& elasticity, const AlignedArray<double>& u,
                           const BodyResponse& expected) {
    elasticity.assemble(u, 1, 0);
    const double scale = expected.hessian.cwiseAbs().maxCoeff();
    AlignedArray<float> x(u.size());
    AlignedArray<float> y(u.size());
    for (std::size_t column = 0; column < x.size(); column += 7) {
        x.set_zero();
        x[column] = 1;
        elasticity.multigrid().product(x.data(), y.data());
        for (std::size_t row = 0; row < y.size(); ++row)
            ASSERT_NEAR(y[row],
                        expected.hessian(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)),
                        3e-6 * scale)
                << "row " << row << " column " << column;
    }
}

}  // namespace windfall::test
