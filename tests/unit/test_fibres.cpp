// Fibres: the plain element against differences and closed forms.
#include "drying/fibres.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "drying/drying_field.h"
#include "support/plain_elements.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::bent_hexahedron;

HexNodes moved(HexNodes nodes, const Matrix3d& by) {
    for (Vector3d& node : nodes) node = by * node;
    return nodes;
}

HexMaterial fibrous_material() {
    HexMaterial material{2, 100, Matrix3d::Identity(), Vector3d(0.9, 0.5, -0.4), 37};
    material.drying << 0.8, 0.02, 0.01, 0.02, 0.85, -0.03, 0.01, -0.03, 0.9;
    return material;
}

TEST(Fibres, DerivativesAgreeWithFiniteDifferences) {
    const HexNodes rest = bent_hexahedron(0.3, 1);
    const HexNodes now = bent_hexahedron(0.4, 2);
    const HexMaterial material = fibrous_material();
    HexMaterial bare = material;
    bare.fibre_modulus = 0;
    const HexResponse response = hexahedron_response(rest, now, material);
    // What is tested must not vanish beside the flesh.
    ASSERT_GT((response.gradient - hexahedron_response(rest, now, bare).gradient).norm(),
              0.05 * response.gradient.norm());
    constexpr double kStep = 1e-5;
    for (int d = 0; d < 24; ++d) {
        HexNodes up = now;
        HexNodes down = now;
        up[d / 3][d % 3] += kStep;
        down[d / 3][d % 3] -= kStep;
        const HexResponse ahead = hexahedron_response(rest, up, material);
        const HexResponse behind = hexahedron_response(rest, down, material);
        EXPECT_NEAR(response.gradient[d], (ahead.energy - behind.energy) / (2 * kStep),
                    1e-6 * response.gradient.norm());
        const auto difference = (ahead.gradient - behind.gradient) / (2 * kStep);
        EXPECT_LT((response.hessian.col(d) - difference).norm(), 1e-6 * response.hessian.norm());
    }
}

TEST(Fibres, AnotherFrameIsTheSame) {
    const HexNodes rest = bent_hexahedron(0.3, 3);
    const HexNodes now = bent_hexahedron(0.4, 4);
    const Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -2).normalized()).toRotationMatrix();
    const HexResponse before = hexahedron_response(rest, now, fibrous_material());
    const HexResponse after = hexahedron_response(rest, moved(now, turn), fibrous_material());
    EXPECT_NEAR(after.energy, before.energy, 1e-12 * before.energy);
    for (int a = 0; a < 8; ++a)
        EXPECT_LT((after.gradient.segment<3>(3 * a) - turn * before.gradient.segment<3>(3 * a)).norm(),
                  1e-11 * before.gradient.norm());
    // And the fruit itself turned, with its fibres.
    HexMaterial turned = fibrous_material();
    turned.fibre = turn * turned.fibre;
    turned.drying = turn * turned.drying * turn.transpose();
    EXPECT_NEAR(hexahedron_response(moved(rest, turn), now, turned).energy, before.energy,
                1e-12 * before.energy);
}

/// A cube of dried size `theta`, its fibres along x of the relaxed length `relaxed`, stretched to `along` in
/// x and `across` in y and z. Force on the face at x = 1 and at y = 1.
struct Pull {
    double theta, relaxed, along, across;
    static constexpr double kShear = 2, kBulk = 30, kModulus = 24;

    HexMaterial material(double modulus = kModulus) const {
        return {kShear, kBulk, theta * Matrix3d::Identity(), Vector3d::UnitX() / relaxed, modulus};
    }
    HexNodes now() const {
        return moved(bent_hexahedron(0, 0), Vector3d(along, across, across).asDiagonal().toDenseMatrix());
    }
    Vector3d force_on_faces(double modulus = kModulus) const {
        const HexNodes rest = bent_hexahedron(0, 0);
        const HexResponse response = hexahedron_response(rest, now(), material(modulus));
        Vector3d sum = Vector3d::Zero();
        for (int a = 0; a < 8; ++a)
            for (int i = 0; i < 3; ++i)
                if (rest[a][i] == 1) sum[i] += response.gradient[3 * a + i];
        return sum;
    }
    /// Derivative of the energy of the block with respect to `along`.
    double expected_along() const {
        const double dried = std::pow(theta, 3), jacobian = along * across * across / dried;
        const double shear = kShear * dried * (along / (theta * theta) - 1 / along);
        const double pressure = kBulk * (jacobian - 1) * across * across;
        const double fibre = along / relaxed;
        return shear + pressure + kModulus * dried / 2 * (fibre * fibre - 1) * fibre / relaxed;
    }
};

TEST(Fibres, BlockIsPulledAlongAndAcross) {
    for (const Pull& pull : {Pull{1, 1, 1.3, 0.9}, Pull{0.8, 0.8, 1, 0.8}, Pull{0.7, 0.9, 0.75, 0.72}}) {
        const Vector3d force = pull.force_on_faces();
        EXPECT_NEAR(force.x(), pull.expected_along(), 1e-11);
        // Across the fibres nothing is added.
        const Vector3d bare = pull.force_on_faces(0);
        EXPECT_NEAR(force.y(), bare.y(), 1e-12);
        EXPECT_GT(std::abs(force.x() - bare.x()), 0.1);
        // Force over the area that it stands on is the Cauchy stress.
        const HexState state = hexahedron_state(bent_hexahedron(0, 0), pull.now(), pull.material());
        EXPECT_NEAR(state.stress(0, 0) * pull.across * pull.across, force.x(), 1e-11);
        EXPECT_NEAR(state.stress(1, 1) * pull.across * pull.along, force.y(), 1e-11);
    }
}

TEST(Fibres, SmallStrainsMeetTheirModulus) {
    constexpr double kStrain = 1e-6;
    const Pull pull{1, 1, 1 + kStrain, 1};
    EXPECT_NEAR((pull.force_on_faces() - pull.force_on_faces(0)).x() / kStrain, Pull::kModulus, 1e-4);
}

TEST(Fibres, DryingWithTheFleshIsFree) {
    // All of the block shrinks alike: nothing holds anything.
    const Pull free{0.7, 0.7, 0.7, 0.7};
    EXPECT_LT(free.force_on_faces().norm(), 1e-12);
    // Fibres that stay longer push.
    EXPECT_LT((Pull{0.7, 0.9, 0.7, 0.7}.force_on_faces().x()), -1);
}

TEST(Fibres, RunWhereTheRecipeSays) {
    const geometry::LayeredMesh mesh = test::small_sphere(8, 8);
    const LayerModuli moduli = layer_moduli(mesh.flesh_layers, mesh.layers, 10, 50);
    EXPECT_TRUE(make_fibres(mesh, {}, moduli).empty());
    FibreParameters parameters;
    parameters.stiffness = 5;
    parameters.shrinkage = 0.5;
    for (const FibreDirection direction :
         {FibreDirection::Radial, FibreDirection::Meridional, FibreDirection::Latitudinal}) {
        parameters.direction = direction;
        const Fibres fibres = make_fibres(mesh, parameters, moduli);
        ASSERT_EQ(fibres.directions.size(), mesh.brick.quads.size());
        for (std::size_t q = 0; q < fibres.directions.size(); ++q) {
            Vector3d radial = Vector3d::Zero();
            for (const std::int32_t vertex : mesh.brick.quads[q]) radial += mesh.directions[vertex];
            radial.normalize();
            const Vector3d& a = fibres.directions[q];
            EXPECT_NEAR(a.norm(), 1, 1e-12);
            EXPECT_NEAR(std::abs(a.dot(radial)), direction == FibreDirection::Radial ? 1 : 0, 1e-3);
            if (direction == FibreDirection::Latitudinal) {
                EXPECT_NEAR(a.y(), 0, 1e-12);
            }
            // Half of a shrinkage to 0.8.
            EXPECT_NEAR(fibres.relaxed(q, 0.8 * Matrix3d::Identity()).norm(), 1 / 0.9, 1e-12);
        }
    }
    EXPECT_EQ(make_fibres(mesh, parameters, moduli).moduli.front(), 10);
    EXPECT_EQ(make_fibres(mesh, parameters, moduli).moduli.back(), 0);
    parameters.layer = FibreLayer::Skin;
    EXPECT_EQ(make_fibres(mesh, parameters, moduli).moduli.front(), 0);
    EXPECT_EQ(make_fibres(mesh, parameters, moduli).moduli.back(), 100);
    parameters.layer = FibreLayer::Both;
    EXPECT_EQ(make_fibres(mesh, parameters, moduli).moduli.front(), 10);
    EXPECT_EQ(make_fibres(mesh, parameters, moduli).moduli.back(), 100);
    parameters.stiffness = 0;
    EXPECT_TRUE(make_fibres(mesh, parameters, moduli).empty());
}

}  // namespace
}  // namespace windfall::drying
