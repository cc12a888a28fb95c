#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "decay/dressing.h"
#include "decay/shading_maps.h"
#include "support/message_of.h"
#include "support/rotten_fruit.h"
#include "take/map_lookup.h"

namespace windfall::decay {
namespace {

using testing::HasSubstr;

constexpr int kSide = 128;

/// Shading maps of a frame, and where to look at them.
struct Shaded {
    std::vector<take::FrameMap> maps;
    geometry::CubeAtlas atlas{kSide};

    explicit Shaded(const take::Frame& frame, const RotLook& look = {}) {
        const ShadingTexels texels(rotten_ball(), 1, kSide, kSide);
        maps = ShadingMaps(texels, look, 3).make(RawMaps(frame, "skin", look), "skin");
    }
    const take::FrameMap& map(const std::string& name) const {
        for (const auto& map : maps)
            if (map.name == name) return map;
        throw std::logic_error("no map " + name);
    }
    /// Mean value (0 .. 1) of a component over the texels `from` to `to` from the middle of the colony.
    double mean(const std::string& name, double from_m, double to_m, std::size_t component = 0) const {
        const take::FrameMap& m = map(name);
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < atlas.texel_count(); ++i) {
            if (!atlas.covered(i)) continue;
            const double r = distance_to_colony_m(atlas.texel_direction(i));
            if (r < from_m || r > to_m) continue;
            sum += m.values[i * static_cast<std::size_t>(m.components) + component] / 65535.0;
            ++count;
        }
        EXPECT_GT(count, 5);
        return sum / count;
    }
};

TEST(ShadingTexels, LieOnTheSkinWithItsScale) {
    const ShadingTexels texels(rotten_ball(kSide, 40), 1, kSide, kSide);
    const geometry::CubeAtlas atlas(kSide);
    std::size_t covered = 0;
    for (std::size_t i = 0; i < atlas.texel_count(); ++i) {
        if (!atlas.covered(i)) continue;
        ++covered;
        ASSERT_EQ(texels.covered[i], 1) << i;
        const geometry::Vec3 wanted = kBallRadius_m * atlas.texel_direction(i);
        ASSERT_LT((texels.places_m[i].cast<double>() - wanted).norm(), 1e-4) << i;
    }
    EXPECT_GT(covered, atlas.texel_count() * 3 / 4);
    // in the middle of a chart, equal angles: 90 degrees over the width of the chart
    const auto middle = atlas.texel_at(geometry::Vec3(0.001, 0.001, 1));
    const double along_x = atlas.chart_width() / (std::numbers::pi / 2 * kBallRadius_m);
    const double along_y = atlas.chart_height() / (std::numbers::pi / 2 * kBallRadius_m);
    EXPECT_NEAR(texels.across_per_m[middle], along_x, 0.02 * along_x);
    EXPECT_NEAR(texels.up_per_m[middle], along_y, 0.02 * along_y);
    // the gutters, where filters look, have places too
    for (std::size_t i = 1; i + 1 < atlas.texel_count(); ++i)
        if (!atlas.covered(i) && atlas.covered(i + 1)) {
            ASSERT_EQ(texels.covered[i], 1) << i;
        }
}

TEST(ShadingTexels, NeedTextureCoordinates) {
    take::TakeMesh bare = rotten_ball();
    bare.rest.corner_uvs.clear();
    EXPECT_THAT(message_of([&] { ShadingTexels(bare, 1, 64, 64); }), HasSubstr("texture coordinates"));
    EXPECT_THROW(ShadingTexels(rotten_ball(), 1, 0, 64), InputError);
}

TEST(ShadingMaps, AFreshSkinHasItsColourAndNoRelief) {
    const Shaded shaded(rotten_frame(0, 0, 0));
    const Eigen::Vector3d orange = RotLook{}.fresh_colour;
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(shaded.mean("base_color", 0, 0.1, k), orange[static_cast<Eigen::Index>(k)], 0.03);
    const auto& base = shaded.map("base_color");
    EXPECT_GT(*std::max_element(base.values.begin(), base.values.end()) / 65535.0, orange.x() + 0.005)
        << "a skin of one colour looks like plastic";
    EXPECT_EQ(shaded.mean("mold_mask", 0, 0.1), 0);
    const auto& displacement = shaded.map("displacement");
    const double metres = displacement.minimum +
                          shaded.mean("displacement", 0, 0.1) * (displacement.maximum - displacement.minimum);
    EXPECT_NEAR(metres, 0, 1e-7);
    EXPECT_NEAR(shaded.mean("normal", 0, 0.1, 2), 1, 1e-4);
}

TEST(ShadingMaps, AColonyHasAWhiteRimAColouredCoreAndAWetBrownMargin) {
    const Shaded shaded(rotten_frame(0, 0.028, 0.018));
    const auto brightness = [&](double from, double to) {
        return (shaded.mean("base_color", from, to, 0) + shaded.mean("base_color", from, to, 1) +
                shaded.mean("base_color", from, to, 2)) /
               3;
    };
    const double core = brightness(0, 0.008), rim = brightness(0.0125, 0.0155),
                 rot = brightness(0.019, 0.022);
    EXPECT_GT(rim, 0.8);
    EXPECT_LT(core, 0.6);
    EXPECT_GT(shaded.mean("base_color", 0, 0.008, 1), shaded.mean("base_color", 0, 0.008, 0)) << "green";
    EXPECT_LT(rot, 0.45);
    EXPECT_GT(shaded.mean("base_color", 0.019, 0.022, 0), 1.4 * shaded.mean("base_color", 0.019, 0.022, 2))
        << "brown";

    EXPECT_GT(shaded.mean("mold_mask", 0, 0.012), 0.95);
    EXPECT_EQ(shaded.mean("mold_mask", 0.0185, 0.1), 0);
    const double fresh = shaded.mean("roughness", 0.032, 0.06);
    EXPECT_GT(shaded.mean("roughness", 0, 0.012), 0.9);
    EXPECT_LT(shaded.mean("roughness", 0.0265, 0.0275), fresh - 0.05) << "the margin is wet";
    EXPECT_GT(shaded.mean("displacement", 0, 0.012), shaded.mean("displacement", 0.032, 0.06));
}

TEST(ShadingMaps, NormalsAreThoseOfTheDisplacement) {
    const Shaded shaded(rotten_frame(0, 0.028, 0.018));
    const ShadingTexels texels(rotten_ball(), 1, kSide, kSide);
    const auto &displacement = shaded.map("displacement"), &normal = shaded.map("normal");
    const auto height = [&](std::size_t i) {
        return displacement.minimum +
               displacement.values[i] / 65535.0 * (displacement.maximum - displacement.minimum);
    };
    double steepest = 0;
    for (const double x : {-0.2, 0.1, 0.3, 0.45}) {
        const std::size_t i = shaded.atlas.texel_at(geometry::Vec3(x, 0.2, 1));
        const double slope_u = (height(i + 1) - height(i - 1)) / 2 * texels.across_per_m[i];
        const double slope_v = (height(i - kSide) - height(i + kSide)) / 2 * texels.up_per_m[i];
        const double length = std::sqrt(1 + slope_u * slope_u + slope_v * slope_v);
        EXPECT_NEAR(2 * normal.values[3 * i] / 65535.0 - 1, -slope_u / length, 2e-3);
        EXPECT_NEAR(2 * normal.values[3 * i + 1] / 65535.0 - 1, -slope_v / length, 2e-3);
        EXPECT_NEAR(2 * normal.values[3 * i + 2] / 65535.0 - 1, 1 / length, 2e-3);
        steepest = std::max(steepest, std::hypot(slope_u, slope_v));
    }
    EXPECT_GT(steepest, 0.02) << "flat, so nothing was compared";
}

TEST(ShadingMaps, AreTheSameBitsOnAnyNumberOfThreads) {
    const take::Frame frame = rotten_frame(0, 0.028, 0.018);
    const Shaded one = [&] {
        const ThreadLimit limit(1);
        return Shaded(frame);
    }();
    const Shaded many(frame);
    for (std::size_t i = 0; i < one.maps.size(); ++i) EXPECT_EQ(one.maps[i].values, many.maps[i].values);
}

TEST(ShadingMaps, BacteriaRotWithoutMold) {
    RotLook look;
    look.species = "Pectobacterium carotovorum";
    const Shaded shaded(rotten_frame(0, 0.028, 0.018), look);
    EXPECT_EQ(shaded.mean("mold_mask", 0, 0.1), 0);
    EXPECT_LT(shaded.mean("base_color", 0, 0.02), 0.7);
}

TEST(RawMaps, FindsFungiBySpeciesAndRefusesSizesThatDiffer) {
    take::Frame frame = rotten_frame(0, 0.02, 0.01, "fungus_penicillium-expansum");
    const RawMaps raw(frame, "skin", {});
    ASSERT_EQ(raw.fungi.size(), 1U);
    EXPECT_EQ(raw.fungi[0].look.key, "expansum");
    ASSERT_NE(raw.fungi[0].active, nullptr);
    EXPECT_EQ(raw.fungi[0].active->name, "fungus_active_penicillium-expansum");
    EXPECT_EQ(RawMaps(frame, "skin_1", {}).any(), nullptr);
    frame.maps[3].width = 64;
    EXPECT_THAT(message_of([&] { RawMaps(frame, "skin", {}); }), HasSubstr("64 x 128"));
}

TEST(RotLook, IsReadFromATake) {
    nlohmann::json json = {{"rot_look.rot_colour", {0.47, 0.28, 0.12}},
                           {"rot_look.full_rot", 0.25},
                           {"rot_look.species", "expansum"},
                           {"look.gloss", 0.5}};  // of pictures
    const RotLook look = rot_look_from_json(json);
    EXPECT_EQ(look.rot_colour, Eigen::Vector3d(0.47, 0.28, 0.12));
    EXPECT_EQ(look.full_rot, 0.25);
    EXPECT_EQ(look.species, "expansum");
    EXPECT_EQ(look.roughness, RotLook{}.roughness);
    json["rot_look.rot_colour"] = {0.1, 2.0, 0.1};
    EXPECT_THAT(message_of([&] { rot_look_from_json(json); }), HasSubstr("rot_look.rot_colour"));
    json["rot_look.rot_colour"] = "brown";
    EXPECT_THROW(rot_look_from_json(json), InputError);
}

TEST(RotLook, KnowsMoldsByAnyOfTheirNames) {
    EXPECT_EQ(mold_look("P. digitatum").key, "digitatum");
    EXPECT_EQ(mold_look("Rhizopus stolonifer").key, "rhizopus");
    EXPECT_EQ(mold_look("pectobacterium-carotovorum").key, "erwinia");
    EXPECT_EQ(mold_look("something new").key, "mold");
    for (const char* key : {"digitatum", "expansum", "rhizopus", "neofabraea", "botrytis", "erwinia"})
        EXPECT_EQ(mold_look(key).key, key);
}

TEST(Dressing, AddsWhatIsMissingOnce) {
    take::Frame frame = rotten_frame(0, 0.028, 0.018);
    DressingSettings settings;
    settings.strands = 2000;
    Dressing dressing({rotten_ball()}, 1, settings);
    dressing.dress(frame);
    EXPECT_EQ(frame.maps.size(), 10U);
    ASSERT_EQ(frame.curves.size(), 1U);
    const auto strands = frame.curves[0].strand_count();
    dressing.dress(frame);
    EXPECT_EQ(frame.maps.size(), 10U);
    EXPECT_EQ(frame.curves.size(), 1U);
    EXPECT_EQ(frame.curves[0].strand_count(), strands);
    take::Frame bare;
    bare.meshes = frame.meshes;
    dressing.dress(bare);
    EXPECT_TRUE(bare.maps.empty() && bare.curves.empty());
}

}  // namespace
}  // namespace windfall::decay
