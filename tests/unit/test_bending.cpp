// Bending: neutral axis, ductile zone and tilt of the break against closed forms and quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fracture/bending.h"

namespace windfall::fracture {
namespace {

constexpr double kPi = std::numbers::pi;

/// Force and moment of the section by the midpoint rule over strips; the twin of the closed forms.
struct Quadrature {
    double force = 0, moment = 0;
    explicit Quadrature(const SectionAtBreak& section) {
        constexpr int kStrips = 200000;
        for (int i = 0; i < kStrips; ++i) {
            const double y = -1 + 2 * (i + 0.5) / kStrips;
            const double strip = 2 * std::sqrt(1 - y * y) * 2 / kStrips;
            force += section.stress(y) * strip;
            moment += section.stress(y) * y * strip;
        }
    }
};

FractureParameters bent(double direction_deg, double twist, Moisture moisture = Moisture::Dry) {
    FractureParameters parameters;
    parameters.load = {LoadSource::Bending, direction_deg, twist};
    parameters.species.moisture = moisture;
    return parameters;
}

double angle_between(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360)); }

TEST(Bending, ElasticSectionHasItsNeutralAxisThroughTheCentre) {
    for (double ratio : {0.2, 0.7, 1.0}) {
        const SectionAtBreak section = section_at_break(ratio);
        EXPECT_EQ(section.neutral_axis, 0);
        EXPECT_EQ(section.yield_line, -1);
        EXPECT_NEAR(section.moment, ratio * kPi / 4, 1e-12);  // sigma = M r / I
    }
}

TEST(Bending, CrushedSectionIsInEquilibrium) {
    for (double ratio : {1.01, 1.5, 2.0, 2.5, 3.0, 4.0, 10.0}) {
        const SectionAtBreak section = section_at_break(ratio);
        const Quadrature sums(section);
        EXPECT_NEAR(sums.force, 0, 2e-6) << ratio;
        EXPECT_NEAR(sums.moment, section.moment, 2e-6) << ratio;
        EXPECT_NEAR(section.stress(1), ratio, 1e-9);
        EXPECT_NEAR(section.stress(section.yield_line), -1, 1e-9);
    }
}

TEST(Bending, NeutralAxisMovesTowardsTheTensionSideAsCompressionGivesWay) {
    double before = 0;
    for (double ratio = 1.1; ratio < 30; ratio *= 1.3) {
        const double axis = section_at_break(ratio).neutral_axis;
        EXPECT_GT(axis, before);
        EXPECT_LT(axis, 1);
        before = axis;
    }
    // Limit: all is crushed at -1, balanced by a sliver of wood at the rim; M tends to the crushed area's
    // arm.
    const SectionAtBreak section = section_at_break(1e6);
    EXPECT_GT(section.neutral_axis, 0.99);
    EXPECT_NEAR(section.moment, kPi, 0.03);
}

TEST(Bending, TensionSideIsOppositeToThePush) {
    EXPECT_NEAR(bending_break(bent(180, 0)).tension_deg, 0, 1e-12);
    EXPECT_NEAR(bending_break(bent(30, 0)).tension_deg, 210, 1e-12);
    EXPECT_NEAR(bending_break(bent(270, 0)).tension_deg, 90, 1e-12);
}

TEST(Bending, DuctileSectorIsTheSegmentUnderTension) {
    for (Moisture moisture : {Moisture::Dry, Moisture::Wet}) {
        const BendingBreak result = bending_break(bent(90, 0, moisture));
        const double axis = section_at_break(strength_ratio(moisture)).neutral_axis;
        EXPECT_NEAR(std::cos(result.ductile.width_deg / 2 * kPi / 180), axis, 1e-12);
        EXPECT_NEAR(result.ductile.depth, 1 - axis, 1e-12);
        EXPECT_EQ(result.ductile.angle_deg, 270);
    }
    EXPECT_GT(bending_break(bent(90, 0, Moisture::Wet)).neutral_axis,
              bending_break(bent(90, 0, Moisture::Dry)).neutral_axis);
}

TEST(Bending, TwistTurnsThePlaneAcrossThePrincipalStress) {
    EXPECT_EQ(bending_break(bent(180, 0)).tilt_deg, 0);
    EXPECT_NEAR(bending_break(bent(180, 1e9)).tilt_deg, 45, 1e-6);  // pure torsion
    double before = 0;
    for (double twist : {0.2, 0.5, 1.0, 3.0}) {
        const BendingBreak result = bending_break(bent(180, twist));
        EXPECT_GT(result.tilt_deg, before);
        before = result.tilt_deg;
        // The eigenvector of (sigma_zz = ratio, sigma_tz = tau) at the outermost fibre is the plane's normal.
        const double ratio = strength_ratio(Moisture::Dry);
        const double tau = twist * section_at_break(ratio).moment / (kPi / 2);
        const double a = result.tilt_deg * kPi / 180;
        const double normal[2] = {std::sin(a), std::cos(a)};  // along the ring (counter-clockwise), along z
        const double traction[2] = {tau * normal[1], tau * normal[0] + ratio * normal[1]};
        EXPECT_NEAR(traction[0] * normal[1] - traction[1] * normal[0], 0, 1e-9);
        EXPECT_GT(traction[0] * normal[0] + traction[1] * normal[1], ratio);
        // z falls along the ring in that sense, so the high side is a quarter turn back.
        EXPECT_NEAR(angle_between(result.tilt_direction_deg, result.tension_deg - 90), 0, 1e-9);
    }
    EXPECT_NEAR(angle_between(bending_break(bent(180, -1)).tilt_direction_deg, 90), 0, 1e-9);
    EXPECT_NEAR(bending_break(bent(180, -1)).tilt_deg, bending_break(bent(180, 1)).tilt_deg, 1e-12);
}

TEST(Bending, ByHandNothingIsReplaced) {
    FractureParameters parameters = bent(77, 2);
    parameters.load.source = LoadSource::ByHand;
    parameters.ductile = {1, 0.2, 33, 44, 0.5};
    parameters.fracture.tilt_deg = 12;
    const FractureParameters result = with_load(parameters);
    EXPECT_EQ(result.ductile.angle_deg, 33);
    EXPECT_EQ(result.ductile.width_deg, 44);
    EXPECT_EQ(result.fracture.tilt_deg, 12);
    EXPECT_EQ(result.bundles.compression, parameters.bundles.compression);
}

TEST(Bending, LoadReplacesAnglesAndKeepsThornsLengths) {
    FractureParameters parameters = bent(0, 0.5);
    parameters.ductile = {1.5, 0.2, 33, 44, 0.5};
    const FractureParameters once = with_load(parameters), twice = with_load(once);
    EXPECT_EQ(once.ductile.angle_deg, 180);
    EXPECT_EQ(once.ductile.length, 1.5);
    EXPECT_EQ(once.ductile.probability, 0.2);
    EXPECT_GT(once.fracture.tilt_deg, 5);
    EXPECT_LT(once.bundles.compression, 0.3);
    EXPECT_EQ(twice.fracture.tilt_deg, once.fracture.tilt_deg);
    EXPECT_EQ(twice.ductile.width_deg, once.ductile.width_deg);
    EXPECT_EQ(twice.bundles.compression, once.bundles.compression);
}

TEST(Bending, BundlesFadeTowardsTheCompressionSide) {
    FractureParameters parameters;  // by hand
    parameters.bundles.compression = 0.1;
    parameters.ductile.angle_deg = 90;
    const TensionField by_hand = tension_field(parameters);
    EXPECT_FLOAT_EQ(by_hand.weight(0.3F, 0.35F), 1);
    EXPECT_FLOAT_EQ(by_hand.weight(-0.3F, -0.25F), 0.1F);
    EXPECT_NEAR(by_hand.weight(0, 0.05F), 0.55F, 1e-6);

    const FractureParameters pushed = bent(270, 0);
    const TensionField bending = tension_field(pushed);
    const auto axis = static_cast<float>(bending_break(pushed).neutral_axis);
    EXPECT_NEAR(bending.weight(0.5F, axis), 0.55F, 1e-5);
    EXPECT_FLOAT_EQ(bending.weight(0, 1), 1);
    EXPECT_FLOAT_EQ(bending.weight(0, -1), 0.1F);
    EXPECT_FLOAT_EQ(tension_field(FractureParameters{}).weight(-1, 0), 1);  // the same all over
}

}  // namespace
}  // namespace windfall::fracture
