#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <random>

#include "recipe/presets.h"
#include "recipe/recipe.h"
#include "recipe/schema.h"

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

template <class Parameters>
void expect_same_bits(const ParameterTable<Parameters>& table, const Parameters& a, const Parameters& b) {
    for (const auto& entry : table.entries()) {
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
    expect_same_bits(drying::drying_parameters(), recipe.drying, again.drying);
    expect_same_bits(picture::look_parameters(), recipe.look, again.look);
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

TEST(Schema, DescribesEveryParameterOnce) {
    const nlohmann::json all = schema();
    const auto& parameters = all.at("processes").at("drying").at("parameters");
    const std::size_t expected =
        drying::drying_parameters().entries().size() + picture::look_parameters().entries().size();
    EXPECT_EQ(parameters.size(), expected);
    std::set<std::string> keys;
    for (const auto& parameter : parameters) {
        EXPECT_FALSE(parameter.at("doc").get<std::string>().empty()) << parameter;
        keys.insert(parameter.at("key").get<std::string>());
    }
    EXPECT_EQ(keys.size(), expected);
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
    const nlohmann::json values = values_json(drying::drying_parameters(), recipe.drying);
    EXPECT_EQ(values.size(), drying::drying_parameters().entries().size());
    EXPECT_EQ(values.at("seed"), 5);
    EXPECT_EQ(values.at("fruit.r4"), recipe.drying.fruit.r4);
    EXPECT_EQ(values.at("imperfection.kind"), "noise");
    EXPECT_EQ(values.at("output.shrinkages"), nlohmann::json::array());
    EXPECT_EQ(values_json(picture::look_parameters(), recipe.look), picture::look_to_json(recipe.look));
}

}  // namespace
}  // namespace windfall::recipe
