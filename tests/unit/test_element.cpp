// The plain hexahedron: derivatives against finite differences, and states whose answer is known.
#include "drying/element.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/plain_elements.h"

namespace windfall::drying {
namespace {

using test::bent_hexahedron;

HexMaterial dried_material() {
    HexMaterial material{2, 100, Eigen::Matrix3d::Identity()};
    material.drying << 0.8, 0.02, 0.01, 0.02, 0.85, -0.03, 0.01, -0.03, 0.9;
    return material;
}

TEST(Element, GradientAgreesWithFiniteDifferences) {
    const HexNodes rest = bent_hexahedron(0.3, 1);
    const HexNodes now = bent_hexahedron(0.4, 2);
    const HexMaterial material = dried_material();
    const HexResponse response = hexahedron_response(rest, now, material);
    ASSERT_GT(response.gradient.norm(), 1);
    constexpr double kStep = 1e-5;
    for (int d = 0; d < 24; ++d) {
        HexNodes up = now;
        HexNodes down = now;
        up[d / 3][d % 3] += kStep;
        down[d / 3][d % 3] -= kStep;
        const double difference = (hexahedron_response(rest, up, material).energy -
                                   hexahedron_response(rest, down, material).energy) /
                                  (2 * kStep);
        EXPECT_NEAR(response.gradient[d], difference, 1e-6 * response.gradient.norm());
    }
}

TEST(Element, HessianAgreesWithFiniteDifferences) {
    const HexNodes rest = bent_hexahedron(0.3, 3);
    const HexNodes now = bent_hexahedron(0.4, 4);
    const HexMaterial material = dried_material();
    const HexResponse response = hexahedron_response(rest, now, material);
    constexpr double kStep = 1e-5;
    for (int d = 0; d < 24; ++d) {
        HexNodes up = now;
        HexNodes down = now;
        up[d / 3][d % 3] += kStep;
        down[d / 3][d % 3] -= kStep;
        const auto difference = ((hexahedron_response(rest, up, material).gradient -
                                  hexahedron_response(rest, down, material).gradient) /
                                 (2 * kStep))
                                    .eval();
        EXPECT_LT((response.hessian.col(d) - difference).norm(), 1e-6 * response.hessian.norm());
    }
}

TEST(Element, FreshStateAndRotationsAreFreeOfForce) {
    const HexNodes rest = bent_hexahedron(0.3, 5);
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
    HexNodes turned;
    for (int a = 0; a < 8; ++a) turned[a] = rotation * rest[a] + Eigen::Vector3d(3, -1, 2);
    const HexMaterial fresh{2, 100, Eigen::Matrix3d::Identity()};
    EXPECT_LT(hexahedron_response(rest, rest, fresh).gradient.norm(), 1e-12);
    EXPECT_LT(hexahedron_response(rest, turned, fresh).gradient.norm(), 1e-11);
    EXPECT_NEAR(hexahedron_response(rest, turned, fresh).energy, 0, 1e-12);
}

TEST(Element, FreeShrinkingIsFreeOfForce) {
    const HexNodes rest = bent_hexahedron(0.3, 6);
    const HexMaterial material = dried_material();
    HexNodes now;
    for (int a = 0; a < 8; ++a) now[a] = material.drying * rest[a];
    const HexResponse response = hexahedron_response(rest, now, material);
    EXPECT_LT(response.gradient.norm(), 1e-12);
    EXPECT_NEAR(response.energy, 0, 1e-13);
    const HexState state = hexahedron_state(rest, now, material);
    EXPECT_NEAR(state.elastic_volume_ratio, 1, 1e-13);
    EXPECT_NEAR(state.volume / state.rest_volume, material.drying.determinant(), 1e-13);
}

TEST(Element, EnergyIsObjective) {
    const HexNodes rest = bent_hexahedron(0.3, 7);
    const HexNodes now = bent_hexahedron(0.4, 8);
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(-1, 0.3, 0.5).normalized()).toRotationMatrix();
    HexNodes turned;
    for (int a = 0; a < 8; ++a) turned[a] = rotation * now[a];
    const HexMaterial material = dried_material();
    const HexResponse before = hexahedron_response(rest, now, material);
    const HexResponse after = hexahedron_response(rest, turned, material);
    EXPECT_NEAR(after.energy, before.energy, 1e-12 * before.energy);
    for (int a = 0; a < 8; ++a)
        EXPECT_LT((after.gradient.segment<3>(3 * a) - rotation * before.gradient.segment<3>(3 * a)).norm(),
                  1e-10);
}

/// The mean stress must do the work of the nodal forces: sum of f_a (x) x_a = V sigma (mean stress theorem).
TEST(Element, StressBalancesNodalForces) {
    const HexNodes rest = bent_hexahedron(0.3, 9);
    const HexNodes now = bent_hexahedron(0.4, 10);
    const HexMaterial material = dried_material();
    const HexResponse response = hexahedron_response(rest, now, material);
    const HexState state = hexahedron_state(rest, now, material);
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) virial += response.gradient.segment<3>(3 * a) * now[a].transpose();
    EXPECT_LT((virial - state.volume * state.stress).norm(), 1e-11 * virial.norm());
}

}  // namespace
}  // namespace windfall::drying
