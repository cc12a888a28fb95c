#include "fracture/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "fracture/plan.h"
#include "support/message_of.h"

namespace windfall::fracture {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(FractureParameters, EveryDefaultIsInItsRange) {
    for (const auto& info : fracture_parameters().infos()) {
        EXPECT_EQ(info.problem_with(info.default_value), "") << info.key;
        EXPECT_FALSE(info.doc.empty()) << info.key;
    }
    EXPECT_NO_THROW(check(FractureParameters{}));
}

TEST(FractureParameters, EveryEntryReachesItsOwnMember) {
    for (const auto& entry : fracture_parameters().entries()) {
        FractureParameters changed;
        ParameterValue value = entry.info.default_value;
        if (auto* number = std::get_if<double>(&value)) *number = 0.123;
        if (auto* integer = std::get_if<std::int64_t>(&value)) *integer += 1;
        if (auto* truth = std::get_if<bool>(&value)) *truth = !*truth;
        if (auto* list = std::get_if<std::vector<double>>(&value)) *list = {0.1};
        if (!entry.info.choices.empty())
            value = entry.info.choices.front() == std::get<std::string>(value) ? entry.info.choices.back()
                                                                               : entry.info.choices.front();
        entry.set(changed, value);
        int differences = 0;
        for (const auto& other : fracture_parameters().entries())
            differences += other.get(changed) != other.info.default_value;
        EXPECT_EQ(differences, 1) << entry.info.key;
        EXPECT_EQ(entry.get(changed), value) << entry.info.key;
    }
}

TEST(FractureParameters, KeysOfAGroupStandTogether) {
    std::set<std::string> left;
    std::string group;
    for (const auto& info : fracture_parameters().infos()) {
        if (info.group() == group) continue;
        EXPECT_TRUE(left.insert(group).second);
        group = info.group();
        EXPECT_FALSE(left.contains(group)) << "[" << group << "] would stand twice in a recipe";
    }
}

/// Yang, Yang, Yang 2019, Table 2: the ends of every range are allowed, what lies beyond is not.
TEST(FractureParameters, RangesAreThoseOfThePaper) {
    struct Range {
        const char* key;
        double least, most;
    };
    const Range ranges[] = {
        {"branch.rings", 3, 400},
        {"branch.sectors", 10, 1000},
        {"tissue.pith", 0, 1},
        {"tissue.heartwood", 0, 1},
        {"tissue.phloem", 0, 1},
        {"roughness.phloem", 0, 5},
        {"roughness.sapwood", 0, 5},
        {"roughness.heartwood", 0, 5},
        {"roughness.phloem_frequency", 1, 10000},
        {"roughness.sapwood_frequency", 1, 10000},
        {"roughness.heartwood_frequency", 1, 10000},
        {"high.height", 0, 20},
        {"high.angle_deg", 0, 360},
        {"high.width_deg", 0, 360},
        {"high.depth", 0, 1},
        {"low.height", -20, 0},
        {"low.angle_deg", 0, 360},
        {"low.width_deg", 0, 360},
        {"low.depth", 0, 1},
        {"ductile.length", 0, 40},
        {"ductile.probability", 0, 1},
        {"ductile.angle_deg", 0, 360},
        {"ductile.width_deg", 0, 360},
        {"ductile.depth", 0, 1},
    };
    for (const auto& [key, least, most] : ranges) {
        SCOPED_TRACE(key);
        const auto* parameter = fracture_parameters().find(key);
        ASSERT_NE(parameter, nullptr);
        const bool integer = std::holds_alternative<std::int64_t>(parameter->info.default_value);
        const auto problem = [&](double value) {
            return integer && std::isfinite(value)
                       ? parameter->info.problem_with(ParameterValue(static_cast<std::int64_t>(value)))
                       : parameter->info.problem_with(ParameterValue(value));
        };
        EXPECT_EQ(problem(least), "");
        EXPECT_EQ(problem(most), "");
        EXPECT_NE(problem(least - 1), "");
        EXPECT_NE(problem(most + 1), "");
        EXPECT_NE(problem(std::numeric_limits<double>::quiet_NaN()), "");
        EXPECT_NE(problem(std::numeric_limits<double>::infinity()), "");
    }
    const auto problem = [](const char* key, double value) {
        return fracture_parameters().find(key)->info.problem_with(ParameterValue(value));
    };
    EXPECT_NE(problem("branch.diameter_m", 0), "") << "a branch must have some thickness";
    EXPECT_EQ(problem("branch.diameter_m", 1e-4), "");
    EXPECT_NE(problem("branch.diameter_m", 9e-5), "");
    EXPECT_EQ(problem("branch.diameter_m", 5), "");
    EXPECT_NE(problem("branch.diameter_m", 5.1), "");
    EXPECT_EQ(problem("break.tilt_deg", 0), "");
    EXPECT_EQ(problem("break.tilt_deg", 89), "");
    EXPECT_NE(problem("break.tilt_deg", 90), "") << "the break would run along the branch for ever";
}

class FractureCheck : public testing::Test {
  protected:
    static std::string complaint(void (*change)(FractureParameters&)) {
        FractureParameters parameters;
        change(parameters);
        return message_of([&] { check(parameters); });
    }
};

TEST_F(FractureCheck, TissuesFillTheRadiusAtMost) {
    EXPECT_THAT(complaint([](auto& p) {
                    p.tissue = {0.3, 0.6, 0.2};
                }),
                AllOf(HasSubstr("tissue.pith, tissue.heartwood and tissue.phloem"), HasSubstr("1.1")));
    FractureParameters full;
    full.tissue = {0.05, 0.85, 0.1};  // 1 but for the last bit
    EXPECT_NO_THROW(check(full));
}

TEST_F(FractureCheck, BundleListsHaveOneLength) {
    EXPECT_THAT(complaint([](auto& p) {
                    p.bundles.radial = {0.3, 0.1};
                }),
                AllOf(HasSubstr("bundles.radial, bundles.angular, bundles.amplitude and bundles.slope"),
                      HasSubstr("2, 0, 0 and 0")));
    EXPECT_THAT(complaint([](auto& p) {
                    const std::vector<double> seven(7, 0.1);
                    p.bundles.radial = p.bundles.angular = p.bundles.amplitude = p.bundles.slope = seven;
                }),
                HasSubstr("7 levels"));
    FractureParameters six;
    six.bundles.radial = six.bundles.angular = six.bundles.amplitude = six.bundles.slope =
        std::vector<double>(6, 0.1);
    EXPECT_NO_THROW(check(six));
}

TEST_F(FractureCheck, HeightsStaySane) {
    EXPECT_THAT(complaint([](auto& p) { p.fracture.tilt_deg = 89.9; }), HasSubstr("lower break.tilt_deg"));
    EXPECT_THAT(complaint([](auto& p) {
                    p.fracture.tilt_deg = 80;
                    p.bundles.radial = p.bundles.angular = p.bundles.slope = std::vector<double>(6, 6.3);
                    p.bundles.amplitude = std::vector<double>(6, 1);
                }),
                HasSubstr("lower bundles.amplitude and bundles.slope"));
    FractureParameters extreme;  // every height of Table 2 at its end
    extreme.high.height = 20;
    extreme.low.height = -20;
    extreme.ductile = {40, 1, 0, 360, 1};
    extreme.branch.taper = 0;
    extreme.roughness.phloem = extreme.roughness.sapwood = extreme.roughness.heartwood = 5;
    EXPECT_NO_THROW(check(extreme));
}

TEST_F(FractureCheck, TheThinEndDoesNotVanish) {
    EXPECT_THAT(complaint([](auto& p) {
                    p.branch.taper = 0.1;
                    p.branch.piece_length = 9.6;
                    p.roughness.phloem = p.roughness.sapwood = p.roughness.heartwood = 0;
                }),
                AllOf(HasSubstr("branch.taper"), HasSubstr("at most 0.0990")));
}

TEST_F(FractureCheck, BendsDoNotFold) {
    EXPECT_THAT(complaint([](auto& p) {
                    p.fracture.end = EndKind::Cut;
                    p.branch.length = p.branch.piece_length = 1;
                    p.branch.taper = 0;
                    p.branch.bend_deg = -120;
                }),
                AllOf(HasSubstr("branch.bend_deg"), HasSubstr("at most 76 degrees")));
}

TEST_F(FractureCheck, ALogDoesNotBreak) {
    EXPECT_THAT(complaint([](auto& p) {
                    p.fracture.end = EndKind::Cut;
                    p.output.motion = Motion::Breaking;
                }),
                AllOf(HasSubstr("output.motion"), HasSubstr("break.end")));
}

TEST(FracturePlan, CountsVerticesAndFrames) {
    FractureParameters p;
    p.branch.rings = 40;
    p.branch.sectors = 100;
    p.branch.layers = 10;
    EXPECT_EQ(plan(p).vertices, 2 * (4000 + 1000 + 2));
    EXPECT_EQ(plan(p).frames, 1);
    p.output.piece = PiecePlace::Hidden;
    EXPECT_EQ(plan(p).vertices, 4000 + 1000 + 2);
    p.output.motion = Motion::Breaking;
    EXPECT_EQ(plan(p).frames, p.output.frames);
}

TEST(FracturePlan, WarnsWhereTheHeightLawIsAGuess) {
    FractureParameters oak;
    oak.species.density_g_cm3 = 0.72;
    oak.species.bending_strength_mpa = 105;
    oak.species.bending_modulus_gpa = 12.5;
    oak.species.splitting_strength_kgf_cm = 25;
    EXPECT_TRUE(plan(oak).warnings.empty()) << "its height comes from the amplitudes";
    oak.fracture.height_from = HeightSource::Species;
    ASSERT_EQ(plan(oak).warnings.size(), 1U);
    EXPECT_THAT(plan(oak).warnings.front(), HasSubstr("break.mean_height"));
    oak.species.name = SpeciesName::Ailanthus;
    EXPECT_TRUE(plan(oak).warnings.empty());
    EXPECT_NEAR(*plan(oak).law_height, 0.745, 0.002);
}

TEST(FracturePlan, WarnsOfBundlesBelowTheLattice) {
    FractureParameters p;
    p.branch.sectors = 40;
    p.bundles.radial = {0.03};
    p.bundles.angular = {0.035};
    p.bundles.amplitude = {0.1};
    p.bundles.slope = {1};
    ASSERT_EQ(plan(p).warnings.size(), 1U);
    EXPECT_THAT(plan(p).warnings.front(),
                AllOf(HasSubstr("bundles.angular"), HasSubstr("branch.sectors = 180")));
    p.branch.sectors = 320;
    EXPECT_TRUE(plan(p).warnings.empty());
}

}  // namespace
}  // namespace windfall::fracture
