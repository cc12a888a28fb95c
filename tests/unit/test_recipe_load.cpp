#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "core/error.h"
#include "recipe/presets.h"
#include "recipe/process.h"
#include "recipe/recipe.h"
#include "support/temporary_folder.h"

namespace windfall::recipe {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Recipe files of one test, in a folder that goes with it.
class RecipeLoad : public testing::Test {
  protected:
    std::string write(const std::string& text, const std::string& name = "fruit.toml") const {
        const fs::path path = m_folder.path() / name;
        std::ofstream(path, std::ios::binary) << text;
        return path.string();
    }

    /// What loading complains of; empty when it does not.
    static std::string complaint(const std::string& recipe, const std::vector<std::string>& settings = {}) {
        try {
            load(recipe, settings);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    const TemporaryFolder m_folder;
};

TEST_F(RecipeLoad, TakesDefaultsWhereTheFileIsSilent) {
    const Recipe recipe = load(write("[fruit]\nr4 = 0.8\n[material]\ngamma = 12\n"));
    const drying::DryingParameters defaults;
    EXPECT_EQ(recipe.drying.fruit.r4, 0.8);
    EXPECT_EQ(recipe.drying.material.gamma, 12);
    EXPECT_EQ(recipe.drying.fruit.r5, defaults.fruit.r5);
    EXPECT_EQ(recipe.drying.seed, defaults.seed);
    EXPECT_EQ(recipe.process, "drying");
    EXPECT_EQ(recipe.name, "fruit");
    EXPECT_EQ(recipe.title, "fruit");
}

TEST_F(RecipeLoad, ReadsTheHeadOfARecipe) {
    const Recipe recipe =
        load(write("process = 'drying'\nname = 'my-plum'\ntitle = 'A plum'\n"
                   "description = 'Blue.'\nsource = ['one', 'two']\nseed = 7\n"));
    EXPECT_EQ(recipe.name, "my-plum");
    EXPECT_EQ(recipe.title, "A plum");
    EXPECT_EQ(recipe.description, "Blue.");
    EXPECT_THAT(recipe.sources, testing::ElementsAre("one", "two"));
    EXPECT_EQ(recipe.drying.seed, 7);
    EXPECT_THAT(load(write("source = 'one'")).sources, testing::ElementsAre("one"));
}

TEST_F(RecipeLoad, BuildsOnAPreset) {
    const Recipe jujube = load("jujube");
    const Recipe mine = load(write("preset = 'jujube'\n[fruit]\nskin_thickness = 0.035\n", "mine.toml"));
    EXPECT_EQ(mine.name, "mine");
    EXPECT_EQ(mine.title, "mine");
    EXPECT_EQ(mine.drying.fruit.skin_thickness, 0.035);
    EXPECT_NE(jujube.drying.fruit.skin_thickness, 0.035);
    EXPECT_EQ(mine.drying.fruit.r4, jujube.drying.fruit.r4);
    EXPECT_EQ(mine.look.dry_colour, jujube.look.dry_colour);
    EXPECT_EQ(mine.sources, jujube.sources);
}

TEST_F(RecipeLoad, ThePresetMayStandAnywhereAboveTheTables) {
    const Recipe mine = load(write("seed = 3\ntitle = 'Mine'\npreset = 'jujube'\n"));
    EXPECT_EQ(mine.drying.seed, 3);
    EXPECT_EQ(mine.title, "Mine");
    EXPECT_NE(mine.drying.fruit.r4, 1.0);
}

TEST_F(RecipeLoad, SettingsComeLast) {
    const std::string file = write("seed = 3\n[fruit]\nr4 = 0.8\n");
    const Recipe recipe =
        load(file, {"fruit.r4=0.9", "seed = 4", "imperfection.kind=modes", "output.shrinkages=[0.1, 0.2]",
                    "title=\"Two words\"", "material.gamma=30", "material.gamma=20"});
    EXPECT_EQ(recipe.drying.fruit.r4, 0.9);
    EXPECT_EQ(recipe.drying.seed, 4);
    EXPECT_EQ(recipe.drying.imperfection.kind, drying::ImperfectionKind::Modes);
    EXPECT_THAT(recipe.drying.output.shrinkages, testing::ElementsAre(0.1, 0.2));
    EXPECT_EQ(recipe.title, "Two words");
    EXPECT_EQ(recipe.drying.material.gamma, 20);
}

TEST_F(RecipeLoad, NamesTheNearestKeyWithLineAndColumn) {
    const std::string file = write("[fruit]\nr4 = 0.8\n  skin_thicknes = 0.03\n");
    EXPECT_EQ(complaint(file),
              file + ":3:3: fruit.skin_thicknes is not a parameter; did you mean fruit.skin_thickness?");
    EXPECT_THAT(complaint(write("gamma = 3")),
                HasSubstr(":1:1: gamma is not a parameter; did you mean material.gamma?"));
    EXPECT_THAT(complaint(write("nonsense = 3")),
                HasSubstr("nonsense is not a parameter; `windfall schema`"));
    EXPECT_THAT(complaint(write("titel = 'x'")), HasSubstr("did you mean title?"));
}

TEST_F(RecipeLoad, NamesTheNearestTable) {
    const std::string text = complaint(write("seed = 1\n\n[friut]\nr4 = 0.8\nr5 = 0.7\n"));
    EXPECT_THAT(text, HasSubstr(":3:"));
    EXPECT_THAT(text, HasSubstr("[friut] is not a table of parameters; did you mean [fruit]?"));
    EXPECT_THAT(text, Not(HasSubstr("r5"))) << "one mistake, one complaint";
    EXPECT_THAT(complaint(write("fruit = 3")), HasSubstr("fruit is a table of parameters: write [fruit]"));
    EXPECT_THAT(complaint(write("[[fruit]]\nr4 = 1")),
                HasSubstr("fruit is a table of parameters: write [fruit]"));
    EXPECT_THAT(complaint(write("[material.gamma]\nx = 1")), HasSubstr("[material.gamma] is not a table"));
}

TEST_F(RecipeLoad, RefusesWhatIsOutOfRange) {
    EXPECT_THAT(complaint(write("[fruit]\nr4 = -1\n")),
                HasSubstr(":2:1: fruit.r4 must be > 0 and <= 10, not -1"));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = 0.0\n")), HasSubstr(":2:1: fruit.r4 must be > 0"));
    EXPECT_THAT(complaint(write("[fruit]\nskin_thickness = 0\n")),
                HasSubstr(":2:1: fruit.skin_thickness must be > 0"));
    EXPECT_THAT(complaint(write("[material]\ngamma = -10.0\n")),
                HasSubstr(":2:1: material.gamma must be > 0"));
    EXPECT_THAT(complaint(write("[drying]\nshrinkage = 1.0\n")),
                HasSubstr(":2:1: drying.shrinkage must be >= 0.001 and < 1"));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = nan\n")), HasSubstr(":2:1: fruit.r4 must be > 0"));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = inf\n")), HasSubstr(":2:1: fruit.r4 must be > 0"));
    EXPECT_THAT(complaint(write("[output]\nshrinkages = [0.1, nan]\n")),
                HasSubstr(":2:1: output.shrinkages every entry must be >= 0 and < 1"));
    EXPECT_THAT(complaint(write("[look]\ndry_colour = [0.1, 0.2]\n")),
                HasSubstr(":2:1: look.dry_colour must have three"));
    EXPECT_THAT(complaint(write("[look]\ndry_colour = [0.1, 0.2, 3]\n")),
                HasSubstr(":2:1: look.dry_colour every entry"));
    EXPECT_THAT(complaint(write("[imperfection]\nkind = 'nois'\n")),
                HasSubstr(":2:1: imperfection.kind must be one of noise, modes, none, not \"nois\""));
    EXPECT_THAT(complaint(write("process = 'rotting'\n")),
                HasSubstr(":1:1: process must be one of drying, fracture, decay, not \"rotting\""));
}

TEST_F(RecipeLoad, RefusesWrongTypes) {
    EXPECT_THAT(complaint(write("[fruit]\nr4 = 'wide'\n")),
                HasSubstr(":2:1: fruit.r4 must be a number, not \"wide\""));
    EXPECT_THAT(complaint(write("[mesh]\nn = 48.5\n")),
                HasSubstr(":2:1: mesh.n must be an integer, not 48.5"));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = true\n")), HasSubstr("must be a number, not true"));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = 2024-01-01\n")), HasSubstr("must be a number, not a date"));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = [1, 2]\n")), HasSubstr("must be a number, not [1.0, 2.0]"));
    EXPECT_THAT(complaint(write("[output]\nshrinkages = ['a']\n")),
                HasSubstr("must be a list of numbers, not a list of texts"));
    EXPECT_THAT(complaint(write("title = 3\n")), HasSubstr(":1:1: title must be a text, not 3"));
    EXPECT_THAT(complaint(write("source = [1]\n")), HasSubstr("source must be a text or a list of texts"));
    EXPECT_THAT(complaint(write("preset = 3\n")), HasSubstr(":1:1: preset must be the name of a preset"));
}

TEST_F(RecipeLoad, TellsAllMistakesAtOnceFromTheTop) {
    const std::string text = complaint(
        write("titel = 'x'\n[fruit]\nr8 = -1\nr4 = 'a'\n[material]\ngamm = 1\n"), {"seed=-1", "nonsense"});
    const char* const expected[] = {":1:1: titel",
                                    ":3:1: fruit.r8",
                                    ":4:1: fruit.r4",
                                    ":6:1: material.gamm",
                                    "--set seed=-1: seed must be",
                                    "--set nonsense: must be key=value"};
    std::size_t at = 0;
    for (const char* part : expected) {
        const auto found = text.find(part, at);
        ASSERT_NE(found, std::string::npos) << part << " is not where it should be in\n" << text;
        at = found;
    }
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
}

TEST_F(RecipeLoad, TellsWhereTomlIsBroken) {
    EXPECT_THAT(complaint(write("[fruit]\nr4 = \n")), AllOf(HasSubstr("fruit.toml:2:"), HasSubstr("rror")));
    EXPECT_THAT(complaint(write("[fruit]\nr4 = 1.0\nr4 = 1.0\n")), HasSubstr("fruit.toml:3:"));
    EXPECT_THAT(complaint(write("title = '\xff\xfe'\n")), HasSubstr("fruit.toml:1:"));
}

TEST_F(RecipeLoad, TheProcessDecidesWhichKeysHold) {
    const Recipe log = load(write("process = 'fracture'\n[branch]\nrings = 12\n[break]\nend = 'cut'\n"));
    EXPECT_EQ(log.process, "fracture");
    EXPECT_EQ(log.fracture.branch.rings, 12);
    EXPECT_EQ(log.fracture.fracture.end, fracture::EndKind::Cut);
    // Wherever it stands: TOML has no order.
    EXPECT_EQ(load(write("seed = 9\nprocess = 'fracture'\n")).fracture.seed, 9);
    EXPECT_EQ(load(write("preset = 'fig2'\n")).process, "fracture");
    EXPECT_EQ(load("fig2", {"output.frames=5"}).fracture.output.frames, 5);
}

TEST_F(RecipeLoad, RefusesKeysOfAnotherProcess) {
    EXPECT_THAT(
        complaint(write("process = 'fracture'\n[fruit]\nr4 = 1\nr5 = 1\n")),
        AllOf(HasSubstr(":3:1: fruit.r4 is a parameter of the process \"drying\", and this is a recipe "
                        "of \"fracture\""),
              Not(HasSubstr("r5"))))
        << "one complaint of a table is enough";
    EXPECT_THAT(complaint(write("[branch]\nrings = 12\n")),
                AllOf(HasSubstr(":2:1: branch.rings is a parameter of the process \"fracture\""),
                      HasSubstr("write process = \"fracture\" above the tables")));
    EXPECT_THAT(complaint("sphere", {"break.tilt_deg=3"}), HasSubstr("process \"fracture\""));
    EXPECT_THAT(complaint("fig2", {"mesh.n=8"}), HasSubstr("process \"drying\""));
    EXPECT_THAT(complaint("fig2", {"branch.ring=8"}), HasSubstr("did you mean branch.rings?"));
    EXPECT_THAT(complaint("fig2", {"look.gloss=0.1"}), HasSubstr("process \"drying\""))
        << "wood has colours of its own";
}

TEST_F(RecipeLoad, TheProcessIsThatOfThePreset) {
    EXPECT_EQ(load(write("preset = 'fig2'\nprocess = 'fracture'\n")).process, "fracture");
    EXPECT_THAT(complaint(write("preset = 'fig2'\nprocess = 'drying'\n")),
                HasSubstr(":2:1: process must be \"fracture\", that of the preset it builds on"));
    EXPECT_THAT(complaint("sphere", {"process=fracture"}),
                HasSubstr("--set process=fracture: process can only stand in a recipe file"));
}

TEST_F(RecipeLoad, PointsAtTheKeysOfABranchThatCannotBe) {
    EXPECT_THAT(complaint(write("process = 'fracture'\n[tissue]\npith = 0.3\nheartwood = 0.9\n")),
                AllOf(HasSubstr("fruit.toml:3:1: "), HasSubstr("tissue.pith, tissue.heartwood")));
    EXPECT_THAT(complaint("fig2", {"break.tilt_deg=89.9"}), HasSubstr("--set break.tilt_deg=89.9: "));
}

TEST_F(RecipeLoad, RefusesFilesThatAreNoRecipes) {
    EXPECT_THAT(complaint((m_folder.path() / "none.toml").string()), HasSubstr("none.toml: No such file"));
    EXPECT_THAT(complaint(m_folder.path().string()), HasSubstr("is a folder"));
    EXPECT_THAT(complaint(write(std::string((1 << 20) + 1, '#'))), HasSubstr("is bigger than 1 MiB"));
    EXPECT_EQ(complaint(write(std::string(1 << 20, '#'))), "") << "exactly 1 MiB is allowed";
    EXPECT_THAT(complaint("/dev/zero"), HasSubstr("is bigger than 1 MiB"));
}

TEST_F(RecipeLoad, RefusesSettingsThatAreNone) {
    const std::string file = write("");
    EXPECT_THAT(complaint(file, {"fruit.r4"}), HasSubstr("--set fruit.r4: must be key=value"));
    EXPECT_THAT(complaint(file, {"=3"}), HasSubstr("no key before the ="));
    EXPECT_THAT(complaint(file, {"fruit.r4="}), HasSubstr("no value behind the ="));
    EXPECT_THAT(complaint(file, {"fruit.r4=0.3.4"}), HasSubstr("0.3.4 is no value"));
    EXPECT_THAT(complaint(file, {"title=two words"}), HasSubstr("a text in quotes"));
    EXPECT_THAT(complaint(file, {"fruit.r4=1\nseed=2"}), HasSubstr("is no value"));
    EXPECT_THAT(complaint(file, {"fruit.r4=.5/2"}), HasSubstr("is no value"));
    EXPECT_THAT(complaint(file, {"fruit.r4=nan"}), HasSubstr("--set fruit.r4=nan: fruit.r4 must be > 0"));
    EXPECT_THAT(complaint(file, {"preset=jujube"}), HasSubstr("preset can only stand in a recipe file"));
    EXPECT_THAT(complaint(file, {"meterial.gamma=3"}), HasSubstr("did you mean material.gamma?"));
}

TEST_F(RecipeLoad, FilesNeedNoQuotes) {
    const std::string file = write("");
    for (const std::string mesh : {"gone.obj", "./gone.obj", "../fruit/gone-2.obj", "/fruit/gone.obj"})
        EXPECT_THAT(complaint(file, {"fruit.mesh=" + mesh}), HasSubstr("there is no such file")) << mesh;
}

TEST_F(RecipeLoad, RefusesNamesThatAreNoFileNames) {
    EXPECT_THAT(complaint(write("name = 'a/b'")),
                HasSubstr(":1:1: the name of a recipe becomes part of file names"));
    EXPECT_THAT(complaint(write("name = ''")), HasSubstr("the name of a recipe"));
    EXPECT_THAT(complaint(write("name = '..'")), HasSubstr("the name of a recipe"));
    EXPECT_THAT(complaint(write("", "\xff.toml")), HasSubstr("the name of a recipe"));
}

TEST_F(RecipeLoad, TellsTheNearestPresets) {
    EXPECT_THAT(complaint("jujub"), HasSubstr("there is no preset \"jujub\"; did you mean jujube"));
    EXPECT_THAT(complaint("walnut"), AllOf(HasSubstr("there are"), HasSubstr("wolfberry")));
    EXPECT_THAT(complaint(write("\npreset = 'jujub'")),
                HasSubstr("fruit.toml:2:1: there is no preset \"jujub\""));
}

TEST_F(RecipeLoad, PointsAtTheKeyOfAFruitThatCannotBe) {
    EXPECT_THAT(complaint(write("[fruit]\nr4 = 1.0\nstone_r1 = 1.2\n")),
                AllOf(HasSubstr("fruit.toml:3:1: "), HasSubstr("fruit.stone_r1")));
    EXPECT_THAT(complaint("sphere", {"fruit.stone_r1=1.2"}), HasSubstr("--set fruit.stone_r1=1.2: "));
}

std::vector<std::string> presets_of(const std::string& process) {
    std::vector<std::string> names;
    for (const std::string& name : preset_names())
        if (load(name).process == process) names.push_back(name);
    return names;
}

TEST(Presets, AllLoad) {
    EXPECT_THAT(presets_of("drying"),
                testing::ElementsAre("banana", "bean", "emblic", "fig", "jujube", "jujube-plump", "mandarin",
                                     "pepper", "plum", "plum-round", "potato", "raisin", "raisin-soaked",
                                     "raisin-sun", "sphere", "wolfberry"));
    EXPECT_THAT(presets_of("fracture"),
                testing::ElementsAre("ailanthus", "chinese-juniper", "cypress", "fig15", "fig16", "fig17",
                                     "fig18", "fig19", "fig2", "goldenrain", "green-branch", "log-end",
                                     "log-end-pine", "storm"));
    for (const std::string& name : preset_names()) {
        SCOPED_TRACE(name);
        const Recipe preset = load(name);
        EXPECT_NO_THROW(process_named(preset.process).check(preset));
        EXPECT_EQ(preset.name, name);
        EXPECT_NE(preset.title, name);
        EXPECT_FALSE(preset.description.empty());
        EXPECT_FALSE(preset.sources.empty());
    }
}

TEST(Presets, BranchesNeedNoWarning) {
    for (const std::string& name : presets_of("fracture")) {
        const Recipe preset = load(name);
        EXPECT_TRUE(process_named("fracture").plan(preset).warnings.empty()) << name;
    }
}

TEST(Presets, FruitsHaveTheStiffnessAndSkinsOfThePaper) {
    for (const std::string& name : presets_of("drying")) {
        SCOPED_TRACE(name);
        const drying::DryingParameters fruit = load(name).drying;
        EXPECT_EQ(fruit.material.gamma, 10);
        EXPECT_GE(fruit.fruit.skin_thickness, 0.025);
        EXPECT_LE(fruit.fruit.skin_thickness, 0.05);
    }
}

/// Yang, Yang, Yang 2019, Table 2, in the order of its rows.
TEST(Presets, FiguresHaveTheNumbersOfThePaper) {
    const std::map<std::string, std::vector<double>> table = {
        {"fig2", {.03, 40, 40, 65, .05, .05, .05, .2, 460, .2, 460, .2, 460,
                  1,   10, 60, 1,  -1,  170, 60,  1,  0,   0,  0,   0,  0}},
        {"fig15", {.01, 100, 100, 0, .05, .45, .125, .06, 2000, .02, 400, .02, 200,
                   0,   0,   0,   0, 0,   180, 0,    0,   .2,   .35, 0,   150, .5}},
        {"fig16", {.01, 40, 40,  0, .05, .75, .05, .02, 460, .02, 460, .02, 460,
                   .5,  0,  180, 1, -.3, 135, 30,  .2,  0,   0,   0,   0,   0}},
        {"fig17", {.01, 100, 100, 0,  .05, 0,   .05, .07, 200, .07, 200, .07, 200,
                   1.8, 0,   150, .6, 0,   180, 0,   0,   5,   .1,  0,   150, .6}},
        {"fig18", {.01, 100, 100, 0,  .05, 0,   .05, .05, 100, 1, 5000, 1, 5000,
                   3,   0,   60,  .2, 0,   180, 0,   0,   0,   0, 0,    0, 0}},
        {"fig19",
         {.01, 40, 40, 45, .05, .3, .1, 1, 200, 1, 200, 1, 200, 0, 0, 0, 0, -4, 180, 80, .25, 0, 0, 0, 0, 0}},
    };
    for (const auto& [name, numbers] : table) {
        SCOPED_TRACE(name);
        const fracture::FractureParameters p = load(name).fracture;
        const std::vector<double> found = {p.branch.diameter_m,
                                           static_cast<double>(p.branch.rings),
                                           static_cast<double>(p.branch.sectors),
                                           p.fracture.tilt_deg,
                                           p.tissue.pith,
                                           p.tissue.heartwood,
                                           p.tissue.phloem,
                                           p.roughness.phloem,
                                           p.roughness.phloem_frequency,
                                           p.roughness.sapwood,
                                           p.roughness.sapwood_frequency,
                                           p.roughness.heartwood,
                                           p.roughness.heartwood_frequency,
                                           p.high.height,
                                           p.high.angle_deg,
                                           p.high.width_deg,
                                           p.high.depth,
                                           p.low.height,
                                           p.low.angle_deg,
                                           p.low.width_deg,
                                           p.low.depth,
                                           p.ductile.length,
                                           p.ductile.probability,
                                           p.ductile.angle_deg,
                                           p.ductile.width_deg,
                                           p.ductile.depth};
        EXPECT_EQ(found, numbers);
        EXPECT_TRUE(p.bundles.radial.empty()) << "the paper's model alone";
        EXPECT_EQ(p.thorns.sapwood_probability, 0);
        EXPECT_EQ(p.fracture.height_from, fracture::HeightSource::Amplitudes);
    }
}

TEST(Presets, SphereIsTheBaseCaseOfThePaper) {
    const drying::FruitParameters fruit = load("sphere").drying.fruit;
    for (const double r : {fruit.r2, fruit.r3, fruit.r4, fruit.r5, fruit.r6, fruit.r7, fruit.r8})
        EXPECT_EQ(r, 1);
    EXPECT_EQ(fruit.stone_r1, 0.4);
    EXPECT_EQ(fruit.stone_r2, 0.4);
    EXPECT_EQ(fruit.skin_thickness, 0.04);
    EXPECT_EQ(load("sphere").drying.drying.shrinkage, 0.3);
}

TEST(Presets, FruitsAreEllipsoids) {
    for (const std::string& name : presets_of("drying")) {
        SCOPED_TRACE(name);
        const drying::FruitParameters fruit = load(name).drying.fruit;
        const double b = fruit.r4;
        const auto radius = [b](double s, double c_sq) { return 1 / std::sqrt(s * s + c_sq / (b * b)); };
        EXPECT_NEAR(fruit.r3, radius(0.5, 0.75), 1e-4);
        EXPECT_NEAR(fruit.r2, radius(std::sqrt(0.75), 0.25), 1e-4);
        EXPECT_EQ(fruit.r5, fruit.r3);
        EXPECT_EQ(fruit.r6, fruit.r2);
        EXPECT_EQ(fruit.r7, 1);
    }
}

}  // namespace
}  // namespace windfall::recipe
