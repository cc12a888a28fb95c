// A small fruit from start to end: numbers, threads, resuming, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "decay/decay_process.h"
#include "decay/organisms_of.h"
#include "decay/rotting_pile.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

using ::testing::HasSubstr;

/// Keeps all that passes.
class Keeper final : public take::FrameSink {
  public:
    void add_mesh(const take::TakeMesh& mesh) override { meshes.push_back(mesh); }
    void add_frame(const take::Frame& frame) override { frames.push_back(frame); }
    void save_checkpoint(std::span<const std::byte> bytes) override {
        checkpoint.assign(bytes.begin(), bytes.end());
    }
    void set_summary(const nlohmann::json& its_summary) override { summary = its_summary; }
    std::vector<take::TakeMesh> meshes;
    std::vector<take::Frame> frames;
    std::vector<std::byte> checkpoint;
    nlohmann::json summary;
};

DecayParameters small_orange() {
    DecayParameters p;
    p.body.skin_cells = 12;
    p.body.flesh_cells = 5;
    p.output.texels = 64;
    p.output.frames = 5;
    p.output.hours_per_frame = 12;
    return p;
}

Keeper rotted(const DecayParameters& p) {
    Keeper keeper;
    run(p, specimen_of(p.fruit), {}, keeper, {}, {});
    return keeper;
}

void expect_same(const take::Frame& a, const take::Frame& b) {
    EXPECT_EQ(a.index, b.index);
    EXPECT_EQ(a.scalars, b.scalars);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t m = 0; m < a.meshes.size(); ++m) EXPECT_EQ(a.meshes[m].positions, b.meshes[m].positions);
    ASSERT_EQ(a.maps.size(), b.maps.size());
    for (std::size_t m = 0; m < a.maps.size(); ++m) EXPECT_EQ(a.maps[m].values, b.maps[m].values);
}

TEST(DecayProcess, OrangeRotsLosesWaterAndKeepsItsAccounts) {
    const Keeper keeper = rotted(small_orange());
    ASSERT_EQ(keeper.frames.size(), 5U);
    ASSERT_EQ(keeper.meshes.size(), 2U);
    EXPECT_EQ(keeper.meshes[0].rest.positions.size(), 6U * 12 * 12 + 2);
    const auto& first = keeper.frames.front().scalars;
    const auto& last = keeper.frames.back().scalars;
    EXPECT_GT(last.at("rot_m2"), 2 * first.at("rot_m2"));
    EXPECT_GT(last.at("water_lost_kg"), 0.005);
    EXPECT_LT(last.at("volume_m3"), 0.97 * first.at("volume_m3"));
    EXPECT_NEAR(last.at("mass_kg") + last.at("water_lost_kg"), 0.140, 1e-10);
    for (const take::Frame& frame : keeper.frames) {
        EXPECT_LE(std::abs(frame.scalars.at("ledger_error")), 1e-9);
        EXPECT_LE(std::abs(frame.scalars.at("conservation_error")), 1e-6);
    }
    // It stands on the table, in the take's axes.
    float lowest = 1;
    for (const auto& p : keeper.frames.back().meshes[0].positions) lowest = std::min(lowest, p.y());
    EXPECT_NEAR(lowest, 0, 1e-3);
}

TEST(DecayProcess, SameBitsOnAnyNumberOfThreads) {
    const Keeper all = rotted(small_orange());
    const ThreadLimit one(1);
    const Keeper single = rotted(small_orange());
    ASSERT_EQ(all.frames.size(), single.frames.size());
    for (std::size_t i = 0; i < all.frames.size(); ++i) expect_same(all.frames[i], single.frames[i]);
}

TEST(DecayProcess, ResumedRunEndsInTheSameBits) {
    DecayParameters p = small_orange();
    const Keeper whole = rotted(p);
    p.output.frames = 3;
    const Keeper part = rotted(p);
    p.output.frames = 5;
    Keeper rest;
    run(p, specimen_of(p.fruit), {}, rest, {}, part.checkpoint);
    ASSERT_EQ(rest.frames.size(), 2U);
    expect_same(whole.frames[3], rest.frames[0]);
    expect_same(whole.frames[4], rest.frames[1]);
}

TEST(DecayProcess, AnotherSeedIsAnotherFruit) {
    DecayParameters p = small_orange();
    p.output.frames = 1;
    const Keeper one = rotted(p);
    p.seed = 2;
    EXPECT_NE(one.frames[0].maps[1].values, rotted(p).frames[0].maps[1].values);
}

TEST(DecayProcess, CancelSavesAndThrows) {
    std::atomic<bool> cancel = true;
    RunContext context;
    context.cancel = &cancel;
    const DecayParameters p = small_orange();
    Keeper keeper;
    EXPECT_THROW(run(p, specimen_of(p.fruit), {}, keeper, context, {}), Cancelled);
}

TEST(DecayProcess, ColdAndDryKeepIt) {
    DecayParameters p = small_orange();
    const double warm = rotted(p).frames.back().scalars.at("mold_m2");
    p.climate.name = water::ClimateName::Fridge;
    const double cold = rotted(p).frames.back().scalars.at("rot_m2");
    EXPECT_GT(warm, 0);
    EXPECT_LT(cold, 0.5 * rotted(small_orange()).frames.back().scalars.at("rot_m2"));
}

TEST(DecayProcess, WoundsBeginWhereTheyAreAsked) {
    DecayParameters p = small_orange();
    p.start = {};
    p.start.random = 0;
    p.start.contacts = false;
    p.start.wounds_m = {0.0, 0.064, 0.0};
    p.output.frames = 1;
    const Keeper keeper = rotted(p);
    const geometry::CubeAtlas atlas(64);
    const take::FrameMap* rot = keeper.frames[0].find_map("skin", "soft_rot");
    ASSERT_NE(rot, nullptr);
    int rotten = 0;
    for (std::size_t i = 0; i < rot->values.size(); ++i)
        if (atlas.covered(i) && rot->values[i] > 0) {
            ++rotten;
            EXPECT_GT(atlas.texel_direction(i).z(), 0.97);
        }
    EXPECT_GT(rotten, 0);

    p.start.wounds_m = {0.5, 0.5, 0.5};
    EXPECT_THAT(message_of([&] { rotted(p); }), HasSubstr("away from the fruit"));
}

TEST(DecayProcess, FungusStaysWhereRotHasBeen) {
    DecayParameters p = small_orange();
    p.growth.fungi = "penicillium-digitatum, rhizopus";
    p.output.frames = 10;
    const Keeper keeper = rotted(p);
    std::vector<bool> rotten(static_cast<std::size_t>(64) * 64, false);
    const geometry::CubeAtlas atlas(64);
    int moldy = 0;
    for (const take::Frame& frame : keeper.frames) {
        const auto* rot = frame.find_map("skin", "soft_rot");
        for (std::size_t i = 0; i < rotten.size(); ++i)
            if (atlas.covered(i) && rot->values[i] > 0) rotten[i] = true;
        for (const char* name : {"fungus_digitatum", "fungus_rhizopus"}) {
            const auto* fungus = frame.find_map("skin", name);
            ASSERT_NE(fungus, nullptr) << name;
            for (std::size_t i = 0; i < rotten.size(); ++i)
                if (atlas.covered(i) && fungus->values[i] > 0) {
                    ++moldy;
                    EXPECT_TRUE(rotten[i]) << frame.index << ' ' << i;
                }
        }
    }
    EXPECT_GT(moldy, 50);
}

TEST(DecayParameters, MistakesAreNamed) {
    const auto complaint = [](auto change) {
        DecayParameters p = small_orange();
        change(p);
        return message_of([&] { check(p); });
    };
    EXPECT_THAT(complaint([](auto& p) { p.fruit.water_kg = p.fruit.mass_kg; }), HasSubstr("fruit.water_kg"));
    EXPECT_THAT(complaint([](auto& p) { p.fruit.kind = FruitKind::Mesh; }), HasSubstr("fruit.mesh"));
    EXPECT_THAT(complaint([](auto& p) { p.start.wounds_m = {1, 2}; }), HasSubstr("start.wounds_m"));
    EXPECT_THAT(complaint([](auto& p) { p.growth.fungi = "erwinia"; }), HasSubstr("soft rot"));
    EXPECT_THAT(complaint([](auto& p) { p.growth.fungi = "penicilium-digitatum"; }),
                HasSubstr("penicillium-digitatum"));
    EXPECT_THAT(complaint([](auto& p) { p.climate.name = water::ClimateName::Table; }),
                HasSubstr("climate.hours"));
    EXPECT_THAT(complaint([](auto& p) { p.output.texels = 101; }), HasSubstr("even"));
    EXPECT_THAT(complaint([](auto& p) {
                    p.start.random = 0;
                    p.start.contacts = false;
                }),
                HasSubstr("nothing begins to rot"));
}

TEST(DecayParameters, FungiAreSplitAtCommas) {
    GrowthParameters growth;
    growth.fungi = " rhizopus ,botrytis,, ";
    EXPECT_EQ(fungus_names(growth), (std::vector<std::string>{"rhizopus", "botrytis"}));
    growth.fungi = "";
    EXPECT_TRUE(fungus_names(growth).empty());
}

TEST(FruitSurfaces, HaveTheVolumeOfTheirMassAndNoFolds) {
    for (const FruitKind kind : {FruitKind::Tomato, FruitKind::Apple, FruitKind::Orange, FruitKind::Peach,
                                 FruitKind::Pear, FruitKind::Ball}) {
        const SurfaceFunction surface = fruit_surface(kind, 0.123);
        EXPECT_NEAR(surface_volume(surface), 0.123e-3, 1e-9);
        EXPECT_NEAR(surface_volume(surface, 96), 0.123e-3, 0.01 * 0.123e-3);
    }
}

}  // namespace
}  // namespace windfall::decay
