#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "recipe/presets.h"
#include "recipe/process.h"
#include "recipe/recipe.h"
#include "recipe/run_recipe.h"
#include "recipe/schema.h"
#include "support/temporary_folder.h"

namespace windfall::recipe {
namespace {

namespace fs = std::filesystem;

Recipe written_and_read(const Recipe& recipe) {
    const fs::path file = fs::path(testing::TempDir()) / "windfall-round-trip.toml";
    std::ofstream(file, std::ios::binary) << to_toml(recipe);
    const Recipe again = load(file.string());
    fs::remove(file);
    return again;
}

void expect_same_bits(const std::vector<Parameter<Recipe>>& table, const Recipe& a, const Recipe& b) {
    for (const auto& entry : table) {
        SCOPED_TRACE(entry.info.key);
        const ParameterValue x = entry.get(a), y = entry.get(b);
        ASSERT_EQ(x, y);
        if (const auto* number = std::get_if<double>(&x)) {
            EXPECT_EQ(std::bit_cast<std::uint64_t>(*number),
                      std::bit_cast<std::uint64_t>(std::get<double>(y)));
        }
    }
}

void expect_round_trip(const Recipe& recipe) {
    const Recipe again = written_and_read(recipe);
    EXPECT_EQ(again.process, recipe.process);
    EXPECT_EQ(again.name, recipe.name);
    EXPECT_EQ(again.title, recipe.title);
    EXPECT_EQ(again.description, recipe.description);
    EXPECT_EQ(again.sources, recipe.sources);
    expect_same_bits(process_named(recipe.process).parameters, recipe, again);
    expect_same_bits(process_named(recipe.process).look, recipe, again);
}

TEST(RecipeRoundTrip, EveryPreset) {
    for (const std::string& name : preset_names()) {
        SCOPED_TRACE(name);
        expect_round_trip(load(name));
    }
}

TEST(RecipeRoundTrip, AwkwardTexts) {
    Recipe recipe = load("sphere");
    recipe.title = "\"quotes\" and \\ and\ttabs\nand lines \x01\x7f ümlaut";
    recipe.sources = {"", "'one'", "# no comment"};
    recipe.name = "with blanks";
    expect_round_trip(recipe);
}

TEST(RecipeRoundTrip, AnyDoublesToTheLastBit) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 200; ++i) {
        Recipe recipe = load("sphere");
        recipe.drying.material.gamma = std::exp2(40 * uniform(random) - 30);
        recipe.drying.fruit.r5 = 0.9 + 0.2 * uniform(random);
        recipe.drying.drying.shrinkage = 0.2 + 0.5 * uniform(random);
        recipe.drying.fruit.size_m = std::exp2(-1000 * uniform(random));
        recipe.drying.seed = static_cast<std::int64_t>(random() >> 11);
        recipe.drying.output.shrinkages = {0.1 * uniform(random), 0.1 + 0.1 * uniform(random)};
        expect_round_trip(recipe);
        if (HasFailure()) break;
    }
}

TEST(RecipeRoundTrip, EveryKeyOfFractureAwayFromItsDefault) {
    Recipe recipe = load("fig2");
    for (const auto& parameter : process_named("fracture").parameters) {
        ParameterValue value = parameter.info.default_value;
        if (auto* number = std::get_if<double>(&value)) *number = *number * 1.07 + 0.0123;
        if (auto* list = std::get_if<std::vector<double>>(&value)) *list = {0.1, 0.2, 0.3};
        if (auto* truth = std::get_if<bool>(&value)) *truth = !*truth;
        if (!parameter.info.choices.empty()) value = parameter.info.choices.back();
        if (parameter.info.problem_with(value).empty()) parameter.set(recipe, value);
    }
    recipe.fracture.fracture.end = fracture::EndKind::Broken;  // a log does not move
    expect_round_trip(recipe);
}

TEST(Schema, DescribesEveryParameterOnce) {
    const nlohmann::json all = schema();
    ASSERT_EQ(all.at("processes").size(), processes().size());
    for (const Process& process : processes()) {
        const auto& parameters = all.at("processes").at(process.name).at("parameters");
        const std::size_t expected = process.parameters.size() + process.look.size();
        EXPECT_EQ(parameters.size(), expected);
        std::set<std::string> keys;
        for (const auto& parameter : parameters) {
            EXPECT_FALSE(parameter.at("doc").get<std::string>().empty()) << parameter;
            keys.insert(parameter.at("key").get<std::string>());
        }
        EXPECT_EQ(keys.size(), expected);
        EXPECT_TRUE(keys.contains("seed"));
    }
    EXPECT_EQ(all.at("processes").at("fracture").at("command"), "snap");
    EXPECT_EQ(all.at("recipe_keys").size(), 6u);
}

TEST(Schema, TellsRangeDefaultAndType) {
    const nlohmann::json all = schema();
    for (const auto& parameter : all.at("processes").at("drying").at("parameters")) {
        if (parameter.at("key") != "drying.shrinkage") continue;
        EXPECT_EQ(parameter.at("type"), "number");
        EXPECT_EQ(parameter.at("group"), "drying");
        EXPECT_EQ(parameter.at("minimum"), 0.001);
        EXPECT_EQ(parameter.at("minimum_excluded"), false);
        EXPECT_EQ(parameter.at("maximum_excluded"), true);
        EXPECT_EQ(parameter.at("maximum"), 1);
        EXPECT_EQ(parameter.at("default"), 0.3);
        EXPECT_EQ(parameter.at("needs_run"), true);
        return;
    }
    FAIL() << "drying.shrinkage is not in the schema";
}

TEST(Schema, ValuesHoldEveryKey) {
    const Recipe recipe = load("plum", {"seed=5"});
    const nlohmann::json values = values_json(process_named("drying").parameters, recipe);
    EXPECT_EQ(values.size(), drying::drying_parameters().entries().size());
    EXPECT_EQ(values.at("seed"), 5);
    EXPECT_EQ(values.at("fruit.r4"), recipe.drying.fruit.r4);
    EXPECT_EQ(values.at("imperfection.kind"), "noise");
    EXPECT_EQ(values.at("output.shrinkages"), nlohmann::json::array());
    EXPECT_EQ(values_json(process_named("drying").look, recipe), picture::look_to_json(recipe.look));
}

TEST(TakeInfo, IsThatOfTheRecipesProcess) {
    const take::TakeInfo branch = take_info(load("fig2", {"seed=7", "branch.diameter_m=0.06"}));
    EXPECT_EQ(branch.process, "fracture");
    EXPECT_EQ(branch.seed, 7U);
    EXPECT_EQ(branch.unit_length_m, 0.03) << "the radius";
    EXPECT_EQ(branch.parameters.at("break.tilt_deg"), 65);
    EXPECT_EQ(branch.look, nlohmann::json::object());
    const take::TakeInfo fruit = take_info(load("plum", {"seed=7"}));
    EXPECT_EQ(fruit.process, "drying");
    EXPECT_EQ(fruit.unit_length_m, load("plum").drying.fruit.size_m);
    EXPECT_FALSE(fruit.look.empty());
}

TEST(IsComplete, LooksAtWhatNeedsARun) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "x.take";
    const Recipe plum = load("plum");
    {
        auto writer = take::TakeWriter::create(path, take_info(plum), false);
        EXPECT_FALSE(is_complete(plum, path));
        writer.set_status(take::TakeStatus::Complete);
    }
    EXPECT_TRUE(is_complete(plum, path));
    EXPECT_TRUE(is_complete(load("plum", {"look.gloss=0.01", "title=other"}), path));
    EXPECT_FALSE(is_complete(load("plum", {"seed=9"}), path));
    EXPECT_FALSE(is_complete(load("fig2"), path));
}

}  // namespace
}  // namespace windfall::recipe
