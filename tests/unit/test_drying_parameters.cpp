#include "drying/parameters.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.h"
#include "drying/drying_field.h"
#include "drying/drying_process.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

TEST(DryingParameters, EveryDefaultIsInItsRange) {
    for (const auto& info : drying_parameters().infos()) {
        EXPECT_EQ(info.problem_with(info.default_value), "") << info.key;
        EXPECT_FALSE(info.doc.empty()) << info.key;
    }
    EXPECT_NO_THROW(check(DryingParameters{}));
}

TEST(DryingParameters, EveryEntryReachesItsOwnMember) {
    for (const auto& entry : drying_parameters().entries()) {
        DryingParameters changed;
        ParameterValue value = entry.info.default_value;
        if (auto* number = std::get_if<double>(&value)) *number = 0.123;
        if (auto* integer = std::get_if<std::int64_t>(&value)) *integer += 1;
        if (auto* list = std::get_if<std::vector<double>>(&value)) *list = {0.1};
        if (auto* text = std::get_if<std::string>(&value)) *text = "x";
        if (!entry.info.choices.empty()) value = entry.info.choices.back();
        entry.set(changed, value);
        int differences = 0;
        for (const auto& other : drying_parameters().entries())
            differences += other.get(changed) != other.info.default_value;
        EXPECT_EQ(differences, 1) << entry.info.key;
        EXPECT_EQ(entry.get(changed), value) << entry.info.key;
    }
}

TEST(DryingParameters, WhatNoSingleRangeSaysIsChecked) {
    const auto refused = [](auto change) {
        DryingParameters p;
        change(p);
        EXPECT_THROW(check(p), InputError);
    };
    refused([](auto& p) { p.mesh.layers = 12; });
    refused([](auto& p) { p.mesh.n = 20; });
    refused([](auto& p) { p.mesh.growth = 0.5; });
    refused([](auto& p) { p.imperfection.shortest_wave = 50; });
    refused([](auto& p) {
        p.drying.radial = 3;
        p.drying.shrinkage = 0.4;
    });
    refused([](auto& p) { p.drying.radial = p.drying.meridional = p.drying.latitudinal = 0; });
    refused([](auto& p) {
        p.imperfection.kind = ImperfectionKind::Modes;
        p.imperfection.linearize_at = 0.95;
    });
    refused([](auto& p) { p.output.shrinkages = {0.1, 0.5}; });
    refused([](auto& p) { p.fruit.stone_r1 = 1.2; });
}

TEST(DryingParameters, FramesBeginFreshAndEndDry) {
    DryingParameters p;
    p.output.frames = 4;
    EXPECT_EQ(frame_shrinkages(p).size(), 4U);
    EXPECT_EQ(frame_shrinkages(p).front(), 0);
    EXPECT_EQ(frame_shrinkages(p).back(), p.drying.shrinkage);
    p.output.shrinkages = {0.2, 0.1, 0.2};
    EXPECT_EQ(frame_shrinkages(p), (std::vector<double>{0, 0.1, 0.2, p.drying.shrinkage}));
}

TEST(DryingParameters, FramesOfRewettingGoUpAndDown) {
    DryingParameters p;
    p.drying.shrinkage = 0.2;
    p.drying.rewet = 0.5;
    p.output.shrinkages = {0.05, 0.15};
    const std::vector<double> asked{0, 0.05, 0.15, 0.2, 0.15, 0.1};
    ASSERT_EQ(frame_shrinkages(p).size(), asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_NEAR(frame_shrinkages(p)[i], asked[i], 1e-12);
    p.output.shrinkages.clear();
    p.output.frames = 3;
    // Even parts of the way, the turn and the end.
    const std::vector<double> frames = frame_shrinkages(p);
    ASSERT_EQ(frames.size(), 4U);
    EXPECT_NEAR(frames[1], 0.15, 1e-12);
    EXPECT_EQ(frames[2], 0.2);
    EXPECT_NEAR(frames[3], 0.1, 1e-12);
}

TEST(Plan, BaseCaseIsThePrototypesMesh) {
    const Plan base = plan(DryingParameters{});
    EXPECT_EQ(base.n, 48);
    EXPECT_EQ(base.layers, 8);
    EXPECT_GE(base.unknowns, 330000);
    EXPECT_TRUE(base.warnings.empty());
}

TEST(Plan, CoarseMeshesAreWarnedAboutWithTheNumberToSet) {
    DryingParameters p;
    p.mesh.n = 24;
    const Plan coarse = plan(p);
    ASSERT_FALSE(coarse.warnings.empty());
    EXPECT_NE(coarse.warnings.front().find("mesh.n = 48"), std::string::npos) << coarse.warnings.front();
}

TEST(Plan, ThinSkinsOnThickFleshGetMoreLayers) {
    DryingParameters p;
    p.fruit.skin_thickness = 0.01;
    EXPECT_EQ(plan(p).layers, 8);
    EXPECT_GE(plan(p).n, 184);
    p.fruit.stone_r1 = p.fruit.stone_r2 = 0.2;
    EXPECT_EQ(plan(p).layers, 16);
}

TEST(DryingField, IsotropicIsExactlyAMultipleOfTheIdentity) {
    const geometry::LayeredMesh mesh = test::small_sphere(4, 8);
    ShrinkageParameters parameters;
    parameters.skin_fraction = 0.5;
    const RecipeDrying drying(mesh, parameters);
    EXPECT_EQ(drying.at(0.2)(3, 0), Eigen::Matrix3d((1 - 0.2) * Eigen::Matrix3d::Identity()));
    EXPECT_EQ(drying.at(0.2)(3, 7), Eigen::Matrix3d((1 - 0.1) * Eigen::Matrix3d::Identity()));
}

TEST(DryingField, DirectionsAreRadialMeridionalLatitudinal) {
    const geometry::LayeredMesh mesh = test::small_sphere(8, 8);
    ShrinkageParameters parameters;
    parameters.radial = 0;
    parameters.meridional = 1;
    parameters.latitudinal = 2;
    const RecipeDrying drying(mesh, parameters);
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q) {
        Eigen::Vector3d radial = Eigen::Vector3d::Zero();
        for (const auto v : mesh.brick.quads[q]) radial += mesh.directions[v];
        radial.normalize();
        const Eigen::Vector3d east = Eigen::Vector3d::UnitY().cross(radial).normalized();
        const Eigen::Matrix3d field = drying.at(0.1)(q, 0);
        ASSERT_NEAR((field * radial - radial).norm(), 0, 1e-12);
        ASSERT_NEAR((field * east - 0.8 * east).norm(), 0, 1e-12);
        ASSERT_NEAR(field.determinant(), 0.9 * 0.8, 1e-12);
    }
}

TEST(Imperfection, NoiseHasItsAmplitudeAndDependsOnTheSeedAlone) {
    DryingParameters p;
    const geometry::LayeredMesh fresh = test::small_sphere(16, 8);
    geometry::LayeredMesh one = fresh;
    geometry::LayeredMesh again = fresh;
    geometry::LayeredMesh other = fresh;
    add_noise(one, p);
    add_noise(again, p);
    p.seed = 2;
    add_noise(other, p);
    double largest = 0;
    bool differs = false;
    for (std::size_t i = 0; i < fresh.nodes.size(); ++i) {
        largest = std::max(largest, (one.nodes[i] - fresh.nodes[i]).norm());
        ASSERT_EQ(one.nodes[i], again.nodes[i]);
        differs |= one.nodes[i] != other.nodes[i];
    }
    EXPECT_NEAR(largest, p.imperfection.amplitude, 1e-12);
    EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace windfall::drying
