#include "decay/pile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "decay/body_pile.h"
#include "support/body_fruit.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

std::vector<PileFruit> oranges(std::size_t count) {
    return std::vector<PileFruit>(count, {test::ribbed_fruit(0.036, 0, 0.03, 0.97), 0.14});
}

TEST(Pile, RestsInABowlWithoutOverlaps) {
    const PileSettings settings{.bowl_radius_m = 0.14, .bowl_height_m = 0.07};
    const SettledPile pile = settle_pile(oranges(3), settings, {});
    ASSERT_EQ(pile.poses.size(), 3U);
    const Ground ground = ground_of(settings);
    for (std::size_t i = 0; i < pile.poses.size(); ++i) {
        const Vec3 at = pile.poses[i].translation_m;
        EXPECT_LT(at.head<2>().norm(), 0.14);
        EXPECT_LT(at.z(), 0.2);
        // Centre at least a smallest radius from the bowl and from other fruit.
        EXPECT_GT(ground(at.cast<float>()).gap_m(at.cast<float>()), 0.032F);
        for (std::size_t j = 0; j < i; ++j) EXPECT_GT((at - pile.poses[j].translation_m).norm(), 0.064);
    }
    int on_ground = 0;
    int between = 0;
    for (const PileContact& c : pile.contacts) {
        EXPECT_NEAR(c.normal.norm(), 1, 1e-6);
        const Vec3 from = pile.poses[c.fruit].translation_m - c.point_m;
        EXPECT_LT(from.norm(), 0.04);
        EXPECT_GT(from.normalized().dot(c.normal), 0.7);  // towards the fruit, from what it touches
        (c.other == kPileGround ? on_ground : between) += 1;
        if (c.other != kPileGround) {
            EXPECT_GT(c.other, c.fruit);
        }
    }
    EXPECT_GT(on_ground, 0);
    EXPECT_GT(between, 0);
}

TEST(Pile, TableIsFlatAndTheSameSeedGivesTheSameBits) {
    PileSettings settings;
    const SettledPile a = settle_pile(oranges(2), settings, {});
    const SettledPile b = settle_pile(oranges(2), settings, {});
    settings.seed = 2;
    const SettledPile c = settle_pile(oranges(2), settings, {});
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(a.poses[i].translation_m, b.poses[i].translation_m);
        EXPECT_EQ(a.poses[i].rotation.coeffs(), b.poses[i].rotation.coeffs());
        EXPECT_NE(a.poses[i].translation_m, c.poses[i].translation_m);
        double lowest = 1;
        const SurfaceFunction surface = posed(oranges(1)[0].surface, a.poses[i]);
        for (int k = 0; k < 4000; ++k) {
            const double z = 1 - (2 * k + 1) / 4000.0;
            const double r = std::sqrt(1 - z * z);
            lowest = std::min(lowest, surface({r * std::cos(2.4 * k), r * std::sin(2.4 * k), z}).z());
        }
        EXPECT_NEAR(lowest, 0, 1.5e-3);
    }
}

TEST(Pile, RefusesWhatCannotBe) {
    EXPECT_THAT(message_of([] { settle_pile({}, {}, {}); }), HasSubstr("at least one fruit"));
    EXPECT_THAT(
        message_of([] { settle_pile(oranges(1), {.bowl_radius_m = 0.04, .bowl_height_m = 0.03}, {}); }),
        HasSubstr("does not fit"));
    EXPECT_THAT(message_of([] { settle_pile(oranges(1), {.bowl_radius_m = 0.2, .bowl_height_m = 0.3}, {}); }),
                HasSubstr("height"));
}

TEST(BodyGround, BowlTurnsInwardsAndIsATableBeside) {
    const Ground bowl = bowl_ground(0.15, 0.07);
    const ContactPlane bottom = bowl({0, 0, 0.01F});
    EXPECT_NEAR(bottom.gap_m({0, 0, 0.01F}), 0.01, 1e-6);
    const Eigen::Vector3f wall(0.1F, 0, 0.03F);
    const double inside = 0.15 - (wall - Eigen::Vector3f(0, 0, 0.15F)).norm();
    EXPECT_NEAR(bowl(wall).gap_m(wall), inside, 1e-6);
    EXPECT_LT(bowl(wall).normal.x(), 0);
    EXPECT_NEAR(bowl({0.3F, 0, 0.02F}).gap_m({0.3F, 0, 0.02F}), 0.02, 1e-6);
}

BodySettings coarse() {
    BodySettings s;
    s.firmness = 60;
    s.thickness = 60;
    s.softening = 0.2;
    s.skin_cells = 16;
    s.flesh_cells = 6;
    s.flesh_layers = 4;
    return s;
}

/// Two fruit side by side, the second leaning on the first, in a bowl.
BodyPile two_in_a_bowl() {
    const auto fruit = oranges(2);
    const PileSettings settings{.bowl_radius_m = 0.11, .bowl_height_m = 0.06};
    static const SettledPile pile = settle_pile(fruit, settings, {});
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < fruit.size(); ++i)
        bodies.emplace_back(posed(fruit[i].surface, pile.poses[i]), coarse());
    BodyPile result(std::move(bodies), ground_of(settings));
    result.settle({});
    return result;
}

TEST(BodyPile, FruitTouchAndDoNotEnterEachOther) {
    BodyPile pile = two_in_a_bowl();
    EXPECT_LT(pile.deepest_overlap_m(), 0.5e-3);
    bool touch = false;
    for (const ContactPatch& patch : pile.patches())
        if (patch.body == 0 && patch.other == 1) touch = patch.vertices.size() >= 3;
    EXPECT_TRUE(touch);
    const Ground ground = bowl_ground(0.11, 0.06);
    for (int f = 1; f <= 30; ++f) {
        const BodyLoad load{.water_fraction_lost = 0.3 * std::min(1.0, f / 20.0),
                            .progress = std::min(1.0, f / 20.0)};
        pile.advance(std::vector<BodyLoad>(2, load));
        EXPECT_LT(pile.deepest_overlap_m(), 0.5e-3) << f;
    }
    for (const Body& body : pile.bodies()) {
        EXPECT_EQ(body.inverted(), 0);
        for (const auto& x : body.skin()) EXPECT_GE(ground(x).gap_m(x), -1e-5F);
    }
    EXPECT_THROW(pile.advance(std::vector<BodyLoad>(3)), InputError);
}

TEST(BodyPile, GoesOnToTheSameBitsFromSavedBodies) {
    BodyPile pile = two_in_a_bowl();
    const auto advance = [](BodyPile& p, int f) {
        p.advance(std::vector<BodyLoad>(2, {.water_fraction_lost = 0.01 * f, .progress = 0.02 * f}));
    };
    for (int f = 1; f <= 10; ++f) advance(pile, f);
    BodyPile again = two_in_a_bowl();
    for (std::size_t i = 0; i < 2; ++i) again.bodies()[i].restore(pile.bodies()[i].save());
    for (int f = 11; f <= 20; ++f) {
        advance(pile, f);
        advance(again, f);
    }
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(again.bodies()[i].save(), pile.bodies()[i].save());
}

}  // namespace
}  // namespace windfall::decay
