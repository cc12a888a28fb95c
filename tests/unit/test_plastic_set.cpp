#include "drying/plastic_set.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "core/random.h"
#include "drying/element.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

using Eigen::Matrix3d;

constexpr double kYield = 0.1;

Matrix3d random_deformation(std::uint64_t seed) {
    Matrix3d result = Matrix3d::Identity();
    for (int i = 0; i < 3; ++i) {
        const auto r = random_uniform4(seed, RandomPurpose::LanczosStart, static_cast<std::uint64_t>(i));
        for (int j = 0; j < 3; ++j) result(i, j) += 0.6 * (r[static_cast<std::size_t>(j)] - 0.5);
    }
    return result;
}

Matrix3d some_drying() { return test::uneven_drying(3, 1); }

/// Energy of a unit cube under a homogeneous deformation.
double energy_of(const Matrix3d& deformation, const Matrix3d& drying, const Matrix3d& set) {
    HexNodes rest, now;
    const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t a = 0; a < 8; ++a) {
        rest[a] = Eigen::Vector3d(corners[a % 4][0], corners[a % 4][1], a < 4 ? 0 : 1);
        now[a] = deformation * rest[a];
    }
    return hexahedron_response(rest, now, {2, 100, stress_free_stretch(drying, set)}).energy;
}

TEST(PlasticSet, NothingFlowsBelowTheYieldStrain) {
    const Matrix3d identity = Matrix3d::Identity();
    const Matrix3d small = Eigen::Vector3d(1.04, 0.98, 0.98).asDiagonal();
    EXPECT_EQ(set_after_flow(small, identity, identity, kYield), identity);
    // Volume alone never yields.
    EXPECT_EQ(set_after_flow(2 * identity, identity, identity, kYield), identity);
    EXPECT_EQ(stress_free_stretch(some_drying(), identity), some_drying());
}

TEST(PlasticSet, FlowEndsAtTheYieldStrain) {
    const Matrix3d stretched = Eigen::Vector3d(1.5, 1 / std::sqrt(1.5), 1 / std::sqrt(1.5)).asDiagonal();
    const Matrix3d identity = Matrix3d::Identity();
    const Matrix3d set = set_after_flow(stretched, identity, identity, kYield);
    // Uniaxial at constant volume: the equivalent strain is the logarithm of the stretch.
    EXPECT_NEAR(set(0, 0), std::pow(1.5 / std::exp(kYield), 2), 1e-12);
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Matrix3d deformation = random_deformation(seed);
        const Matrix3d flowed = set_after_flow(deformation, some_drying(), identity, kYield);
        const Matrix3d elastic = deformation * stress_free_stretch(some_drying(), flowed).inverse();
        EXPECT_LE(equivalent_elastic_strain(elastic), kYield * (1 + 1e-9));
        EXPECT_NEAR(flowed.determinant(), 1, 1e-12);
        EXPECT_EQ(flowed, flowed.transpose().eval());
    }
}

TEST(PlasticSet, FlowDissipates) {
    const Matrix3d identity = Matrix3d::Identity();
    int flowed = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        // Twice, so that the second flow starts from a set that is not I.
        const Matrix3d first = set_after_flow(random_deformation(seed), some_drying(), identity, kYield);
        const Matrix3d deformation = random_deformation(seed + 1000);
        if (deformation.determinant() < 0.3) continue;
        const Matrix3d second = set_after_flow(deformation, some_drying(), first, kYield);
        if (second == first) continue;
        ++flowed;
        EXPECT_LT(energy_of(deformation, some_drying(), second),
                  energy_of(deformation, some_drying(), first));
    }
    EXPECT_GT(flowed, 20);
}

TEST(PlasticSet, RotatingTheFruitChangesNothing) {
    const Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Matrix3d deformation = random_deformation(5);
    const Matrix3d set = set_after_flow(deformation, some_drying(), Matrix3d::Identity(), kYield);
    EXPECT_FALSE(set.isApprox(Matrix3d::Identity(), 1e-3));
    EXPECT_TRUE(
        set.isApprox(set_after_flow(turn * deformation, some_drying(), Matrix3d::Identity(), kYield), 1e-12));
}

TEST(PlasticSet, OnlyTheLayersThatYieldFlow) {
    const geometry::LayeredMesh mesh = test::small_sphere(4, 8);
    std::vector<geometry::Vec3> nodes = mesh.nodes;
    for (auto& x : nodes) x.y() *= 1.4;
    PlasticSet set;
    const DryingField fresh = [](std::size_t, int) { return Matrix3d(Matrix3d::Identity()); };
    flow(set, mesh, nodes, fresh, {0, kYield});
    ASSERT_EQ(set.size(), mesh.brick.quads.size() * 8 * 6);
    const DryingField field = with_set(fresh, set, 8);
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q) {
        EXPECT_EQ(field(q, 0), Matrix3d::Identity());
        EXPECT_GT(field(q, 7)(1, 1), 1.1);
    }
}

}  // namespace
}  // namespace windfall::drying
