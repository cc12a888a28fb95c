#include "fracture/wood_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/parallel.h"
#include "fracture/parameters_colours.h"
#include "fracture/wood_palette.h"
#include "support/message_of.h"
#include "support/synthetic_branch.h"

namespace windfall::fracture {
namespace {

FractureParameters wood_like(WoodKind wood) {
    FractureParameters parameters;
    parameters.colours.wood = wood;
    parameters.tissue = wood_palette(wood).tissue;
    return parameters;
}

/// Vertices of one tissue along a ray, from `from` to `to`.
BranchMesh ray_of(Tissue tissue, float from, float to, float angle, int count) {
    BranchMesh mesh;
    for (int i = 0; i < count; ++i) {
        const float r = from + (to - from) * static_cast<float>(i) / static_cast<float>(count - 1);
        mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.2F);
        mesh.height.push_back(0.2F);
        mesh.thorn.push_back(0);
        mesh.tissue.push_back(tissue);
        mesh.bundle.push_back(7);
    }
    return mesh;
}

float brightness(const Vector3f& c) { return 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z(); }

Vector3f mean_over(const std::vector<Vector3f>& colours) {
    Vector3f sum = Vector3f::Zero();
    for (const Vector3f& c : colours) sum += c;
    return sum / static_cast<float>(colours.size());
}

TEST(WoodColour, DependsOnPlaceAndSeedAlone) {
    const auto parameters = wood_like(WoodKind::Juniperus);
    const auto fine = test::synthetic_branch({.rings = 12, .sectors = 40});
    const auto all = vertex_colours(fine, parameters);
    BranchMesh some;  // every third vertex, backwards
    std::vector<Vector3f> expected;
    for (std::size_t v = fine.vertex_count(); v-- > 0;) {
        if (v % 3 != 0) continue;
        some.positions.push_back(fine.positions[v]);
        some.height.push_back(fine.height[v]);
        some.thorn.push_back(fine.thorn[v]);
        some.tissue.push_back(fine.tissue[v]);
        some.bundle.push_back(fine.bundle[v]);
        expected.push_back(all[v]);
    }
    ASSERT_GT(expected.size(), 100U);
    EXPECT_EQ(vertex_colours(some, parameters), expected);
    {
        const ThreadLimit one(1);
        EXPECT_EQ(vertex_colours(fine, parameters), all);
    }
    auto other_seed = parameters;
    other_seed.seed = 2;
    EXPECT_NE(vertex_colours(fine, other_seed), all);
}

TEST(WoodColour, TissuesHaveTheirColours) {
    const auto parameters = wood_like(WoodKind::Juniperus);
    const auto mean = [&](Tissue tissue, float from, float to) {
        return mean_over(vertex_colours(ray_of(tissue, from, to, 1, 200), parameters));
    };
    const Vector3f heartwood = mean(Tissue::Heartwood, 0.1F, 0.5F),
                   sapwood = mean(Tissue::Sapwood, 0.65F, 0.9F);
    const Vector3f phloem = mean(Tissue::Phloem, 0.95F, 0.99F), bark = mean(Tissue::Bark, 1, 1);
    EXPECT_GT(brightness(sapwood), 1.5F * brightness(heartwood));
    EXPECT_GT(heartwood.x() / heartwood.y(), 1.3F * sapwood.x() / sapwood.y());  // red
    EXPECT_GT(brightness(heartwood), brightness(bark));
    EXPECT_GT(brightness(sapwood), 2 * brightness(phloem));
    EXPECT_LT(brightness(mean(Tissue::Pith, 0, 0.02F)), brightness(heartwood));
}

/// Dark places along a ray: where the brightness falls through its mean.
int rings_along(const FractureParameters& parameters, float angle) {
    const auto colours = vertex_colours(ray_of(Tissue::Sapwood, 0.1F, 0.9F, angle, 2000), parameters);
    const float mean = brightness(mean_over(colours));
    int falls = 0;
    bool above = true;
    for (const Vector3f& c : colours) {
        if (above && brightness(c) < 0.93F * mean) ++falls;
        if (brightness(c) < 0.93F * mean) above = false;
        if (brightness(c) > mean) above = true;
    }
    return falls;
}

TEST(WoodColour, AnnualRingsHaveTheAskedWidthAndWander) {
    auto parameters = wood_like(WoodKind::Pine);
    parameters.tissue = {.pith = 0, .heartwood = 0, .phloem = 0};
    parameters.colours.streaks = 0;
    for (const double width : {0.05, 0.1}) {
        parameters.colours.ring_width = width;
        for (const float angle : {0.3F, 2.0F, 4.5F})
            EXPECT_NEAR(rings_along(parameters, angle), 0.8 / width, 0.25 / width) << width << " " << angle;
    }
    // the same radius is not the same part of a ring all around
    std::set<bool> sides;
    BranchMesh circle;
    for (int i = 0; i < 200; ++i) {
        const auto at = ray_of(Tissue::Sapwood, 0.7F, 0.71F, 0.0314F * static_cast<float>(i), 2);
        circle.positions.push_back(at.positions[0]);
        circle.height.push_back(0);
        circle.thorn.push_back(0);
        circle.tissue.push_back(Tissue::Sapwood);
        circle.bundle.push_back(7);
    }
    const auto around = vertex_colours(circle, parameters);
    const float mean = brightness(mean_over(around));
    for (const Vector3f& c : around) sides.insert(brightness(c) > 1.03F * mean);
    EXPECT_EQ(sides.size(), 2U);
}

TEST(WoodColour, HeartwoodEndsWhereItsShareDoes) {
    auto parameters = wood_like(WoodKind::Juniperus);
    parameters.colours.late_wood = parameters.colours.streaks = 0;
    parameters.tissue = {.pith = 0.05, .heartwood = 0.5, .phloem = 0.05};
    const auto colours = vertex_colours(ray_of(Tissue::Sapwood, 0, 1, 0.4F, 401), parameters);
    const auto redness = [&](std::size_t i) { return colours[i].x() / colours[i].y(); };
    EXPECT_GT(redness(180), 1.3F * redness(260));  // r = 0.45 and 0.65, either side of 0.55
}

TEST(WoodColour, BundlesDifferAndThornsGrowPale) {
    auto parameters = wood_like(WoodKind::Ailanthus);
    BranchMesh one = ray_of(Tissue::Sapwood, 0.5F, 0.9F, 1, 50), other = one;
    for (auto& bundle : other.bundle) bundle = 99;
    EXPECT_NE(vertex_colours(one, parameters), vertex_colours(other, parameters));
    parameters.colours.variation = 0;
    EXPECT_EQ(vertex_colours(one, parameters), vertex_colours(other, parameters));
    BranchMesh thorns = one;
    for (auto& thorn : thorns.thorn) thorn = 1;
    EXPECT_GT(brightness(mean_over(vertex_colours(thorns, parameters))),
              1.1F * brightness(mean_over(vertex_colours(one, parameters))));
}

TEST(WoodColour, WetWoodIsDarkerAndGreenUnderTheBark) {
    const auto dry = wood_like(WoodKind::Ailanthus);
    auto wet = dry;
    wet.species.moisture = Moisture::Wet;
    const auto sapwood = ray_of(Tissue::Sapwood, 0.5F, 0.9F, 1, 50);
    EXPECT_LT(brightness(mean_over(vertex_colours(sapwood, wet))),
              0.97F * brightness(mean_over(vertex_colours(sapwood, dry))));
    const auto phloem = ray_of(Tissue::Phloem, 0.921F, 0.935F, 1, 50);  // the cambium: next to the wood
    const Vector3f wet_phloem = mean_over(vertex_colours(phloem, wet)),
                   dry_phloem = mean_over(vertex_colours(phloem, dry));
    EXPECT_GT(wet_phloem.y(), wet_phloem.x());
    EXPECT_LT(dry_phloem.y(), dry_phloem.x());
}

TEST(WoodColour, AnArtistsColourTakesThePalettesPlace) {
    auto parameters = wood_like(WoodKind::Oak);
    parameters.colours.sapwood = {0.1, 0.2, 0.9};
    const Vector3f blue = mean_over(vertex_colours(ray_of(Tissue::Sapwood, 0.85F, 0.92F, 1, 50), parameters));
    EXPECT_GT(blue.z(), 3 * blue.x());
    parameters.colours.sapwood = {0.1, 0.2};
    EXPECT_THAT(message_of([&] { check_colours(parameters); }), testing::HasSubstr("colours.sapwood"));
    parameters.colours.sapwood = {};
    EXPECT_NO_THROW(check_colours(parameters));
}

TEST(WoodColour, StaysBetweenBlackAndWhiteForAllWoodsAtTheirExtremes) {
    const auto branch = test::synthetic_branch({});
    for (int wood = 1; wood <= static_cast<int>(WoodKind::Green); ++wood)
        for (const double strength : {0.0, 5.0})
            for (const Moisture moisture : {Moisture::Dry, Moisture::Wet}) {
                auto parameters = wood_like(static_cast<WoodKind>(wood));
                parameters.species.moisture = moisture;
                parameters.colours.variation = parameters.colours.streaks = strength;
                parameters.colours.late_wood = parameters.colours.wetness = 0.6 * strength;
                parameters.colours.weathering = 0.2 * strength;
                for (const Vector3f& c : vertex_colours(branch, parameters))
                    ASSERT_TRUE(c.allFinite() && c.minCoeff() >= 0 && c.maxCoeff() <= 1) << wood << c;
            }
}

TEST(WoodColour, WoodFollowsTheSpeciesUntilItIsSet) {
    FractureParameters parameters;
    EXPECT_EQ(wood_of(parameters), WoodKind::Plain);
    parameters.species.name = SpeciesName::Koelreuteria;
    EXPECT_EQ(wood_of(parameters), WoodKind::Koelreuteria);
    parameters.colours.wood = WoodKind::Pine;
    EXPECT_EQ(wood_of(parameters), WoodKind::Pine);
    for (int wood = 1; wood <= static_cast<int>(WoodKind::Green); ++wood) {
        const TissueParameters& tissue = wood_palette(static_cast<WoodKind>(wood)).tissue;
        EXPECT_LT(tissue.pith + tissue.heartwood + tissue.phloem, 1) << wood;
    }
}

TEST(WoodColour, ParametersReachTheTable) {
    ParameterTable<FractureParameters> table;
    add_colours(table);
    FractureParameters parameters;
    table.find("colours.wood")->set(parameters, std::string("oak"));
    EXPECT_EQ(parameters.colours.wood, WoodKind::Oak);
    table.find("colours.wood")->set(parameters, std::string("green"));
    EXPECT_EQ(parameters.colours.wood, WoodKind::Green);
    table.find("colours.bark")->set(parameters, std::vector<double>{0.1, 0.2, 0.3});
    EXPECT_EQ(parameters.colours.bark, (std::vector<double>{0.1, 0.2, 0.3}));
    table.find("colours.ring_width")->set(parameters, 0.2);
    EXPECT_EQ(parameters.colours.ring_width, 0.2);
    EXPECT_NE(table.find("colours.bark")->info.problem_with(std::vector<double>{2, 0, 0}), "");
}

}  // namespace
}  // namespace windfall::fracture
