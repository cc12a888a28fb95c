#include "fracture/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "recipe/recipe.h"
#include "recipe/run_recipe.h"
#include "support/temporary_folder.h"

namespace windfall::fracture {
namespace {

using nlohmann::json;

/// A break without anything that makes the branch other than a cylinder.
const std::vector<std::string> kPlain = {
    "branch.outline=0",    "branch.bark_relief=0",  "branch.taper=0",    "roughness.phloem=0",
    "roughness.sapwood=0", "roughness.heartwood=0", "ductile.length=0",  "high.height=0",
    "low.height=0",        "branch.rings=40",       "branch.sectors=120"};

json measured(const std::string& preset, std::vector<std::string> settings, bool plain = false) {
    if (plain) settings.insert(settings.begin(), kPlain.begin(), kPlain.end());
    const TemporaryFolder folder;
    const auto path = folder.path() / "x.take";
    const recipe::Recipe recipe = recipe::load(preset, settings);
    {
        auto writer = take::TakeWriter::create(path, recipe::take_info(recipe), false);
        recipe::run(recipe, writer, {});
    }
    return measure(take::TakeReader(path));
}

TEST(FractureMeasure, BothEndsFillTheBranch) {
    const json result =
        measured("fig2", {"break.tilt_deg=40", "branch.length=3", "branch.piece_length=2"}, true);
    const json& frame = result.at("frames").at(0);
    const double length = 3 + 2 + result.at("highest").get<double>() - result.at("lowest").get<double>();
    EXPECT_NEAR(frame.at("stub_volume").get<double>() + frame.at("piece_volume").get<double>(),
                std::numbers::pi * length, 0.01 * std::numbers::pi * length);
}

TEST(FractureMeasure, OfATiltedPlane) {
    const json result = measured("fig2", {"break.tilt_deg=60"}, true);
    const double tilt = std::tan(60 * std::numbers::pi / 180);
    EXPECT_NEAR(result.at("area_over_section").get<double>(), 2, 0.03);
    EXPECT_NEAR(result.at("highest").get<double>(), tilt, 0.02 * tilt);
    EXPECT_NEAR(result.at("lowest").get<double>(), -tilt, 0.02 * tilt);
    EXPECT_NEAR(result.at("mean_height").get<double>(), tilt, 0.02 * tilt);
    EXPECT_NEAR(result.at("fractal_dimension").get<double>(), 2, 0.03);
    EXPECT_EQ(result.at("stub_thorns"), 0);
    // Pith to 0.05, heartwood to 0.1, phloem from 0.95 of the radius.
    EXPECT_NEAR(result.at("area_sapwood").get<double>() / result.at("area").get<double>(), 0.95 * 0.95 - 0.01,
                0.025);
    EXPECT_NEAR(result.at("area_phloem").get<double>() / result.at("area").get<double>(), 1 - 0.95 * 0.95,
                0.025);
}

TEST(FractureMeasure, ABentBranchHasTheSameSurface) {
    const auto dimension = [](const std::string& bend) {
        return measured("fig15", {"branch.bend_deg=" + bend, "branch.rings=40", "branch.sectors=80"})
            .at("fractal_dimension")
            .get<double>();
    };
    EXPECT_NEAR(dimension("40"), dimension("0"), 0.002);
}

TEST(FractureMeasure, DimensionRisesWithLambda) {
    double before = 1.9;
    for (const char* lambda : {"0", "0.01", "0.04", "0.15", "0.5"}) {
        const std::string value = lambda;
        const json result =
            measured("fig15", {"roughness.phloem=" + value, "roughness.sapwood=" + value,
                               "roughness.heartwood=" + value, "roughness.sapwood_frequency=2000",
                               "roughness.heartwood_frequency=2000", "ductile.probability=0",
                               "branch.rings=60", "branch.sectors=120"});
        const double dimension = result.at("fractal_dimension").get<double>();
        EXPECT_GT(dimension, before) << lambda;
        before = dimension;
    }
    EXPECT_GT(before, 2.2);
}

TEST(FractureMeasure, SpeciesHaveTheirHeight) {
    const json juniper = measured("cypress", {"branch.rings=24", "branch.sectors=60", "fringe.strands=0"});
    EXPECT_NEAR(juniper.at("law_height").get<double>(), 6.68, 0.005);
    EXPECT_NEAR(juniper.at("mean_height").get<double>() / juniper.at("law_height").get<double>(), 1, 0.02);
    EXPECT_FALSE(juniper.contains("law_warning"));
    const json oak = measured("fig2", {"species.density_g_cm3=0.72", "species.bending_strength_mpa=105"});
    EXPECT_TRUE(oak.contains("law_warning"));
}

TEST(FractureMeasure, OfACrackedLog) {
    const json log = measured("log-end", {"branch.rings=40", "branch.sectors=120", "branch.layers=12"});
    EXPECT_GT(log.at("cracks_asked").get<int>(), 80);
    EXPECT_GE(log.at("cracks_opened").get<int>(), 1);
    EXPECT_EQ(log.at("cracks_asked"),
              log.at("cracks_opened").get<int>() + log.at("cracks_dropped").get<int>());
    EXPECT_GT(log.at("area_over_section").get<double>(), 1) << "the walls of the cracks count";
    EXPECT_FALSE(log.contains("fractal_dimension"));
    EXPECT_FALSE(log.at("frames").at(0).contains("piece_volume"));
}

TEST(FractureMeasure, NeedsFrames) {
    const TemporaryFolder folder;
    const recipe::Recipe recipe = recipe::load("fig2");
    const auto path = folder.path() / "x.take";
    const auto writer = take::TakeWriter::create(path, recipe::take_info(recipe), false);
    EXPECT_THROW(measure(take::TakeReader(path)), InputError);
}

}  // namespace
}  // namespace windfall::fracture
