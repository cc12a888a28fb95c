#include "decay/colonies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/growth_ball.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;

StartingPoint wound(const Vec3& direction, std::size_t organism) {
    return {0.035 * direction.normalized(), organism, 0.3, 0.003};
}

TEST(Colonies, AFungusWaitsForTheRot) {
    GrowthBall ball(64, even_settings());
    Colonies colonies({}, 1);
    colonies.start(ball.growth, wound(Vec3(1, 0.4, 0), 1));
    EXPECT_EQ(colonies.list().size(), 0U);
    EXPECT_EQ(colonies.waiting_count(), 1U);
    colonies.start(ball.growth, wound(Vec3(1, 0, 0), 0));
    EXPECT_EQ(colonies.list().size(), 1U);
    for (int hour = 0; hour < 24 * 12 && colonies.waiting_count() > 0; ++hour) {
        ball.growth.advance(1, {});
        colonies.spread(ball.growth);
        if (colonies.waiting_count() > 0) {
            ASSERT_EQ(ball.growth.area_over(1, 1e-6), 0);
        }
    }
    EXPECT_EQ(colonies.waiting_count(), 0U);
    EXPECT_GT(ball.growth.area_over(1, 0.1), 0);
}

std::size_t colonies_after(double propagation, int days, std::uint64_t seed, std::size_t most = 500) {
    GrowthBall ball(64);
    ColonySettings settings;
    settings.propagation = propagation;
    settings.most = most;
    Colonies colonies(settings, seed);
    for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0)})
        colonies.start(ball.growth, wound(d, 0));
    for (int day = 0; day < days; ++day) {
        ball.growth.advance(24, {.temperature_c = 12});
        colonies.spread(ball.growth);
    }
    return colonies.list().size();
}

TEST(Colonies, MorePropagationMakesMoreButNoExplosion) {
    std::size_t few = 0, many = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        few += colonies_after(3, 8, seed);
        many += colonies_after(8, 8, seed);
    }
    EXPECT_GT(few, 4U * 4);  // some are new
    EXPECT_LT(few, 4U * 20);
    EXPECT_GT(many, few);
    EXPECT_EQ(colonies_after(9, 8, 1, 25), 25U);
}

TEST(Colonies, SeedsFallWithinReachOnFoodAndFungiOnlyOnRot) {
    GrowthBall ball(96);
    ColonySettings settings;
    settings.propagation = 9;
    Colonies colonies(settings, 5);
    colonies.start(ball.growth, wound(Vec3(1, 0, 0), 0));
    ball.growth.advance(120, {});  // the rot's lead gives the fungus room
    colonies.start(ball.growth, wound(Vec3(1, 0, 0), 1));
    std::size_t known = colonies.list().size();
    std::size_t fungi = 0;
    for (int day = 0; day < 14; ++day) {
        ball.growth.advance(24, {});
        const std::vector<float> gate(ball.growth.gate().begin(), ball.growth.gate().end());
        const std::vector<float> food(ball.growth.nutrient().begin(), ball.growth.nutrient().end());
        colonies.spread(ball.growth);
        for (; known < colonies.list().size(); ++known) {
            const Colony& colony = colonies.list()[known];
            EXPECT_GE(food[colony.texel], settings.poor_nutrient);
            double nearest = 1;
            for (std::size_t k = 0; k < known; ++k)
                if (colonies.list()[k].organism == colony.organism)
                    nearest = std::min(nearest, (ball.growth.positions_m()[colonies.list()[k].texel] -
                                                 ball.growth.positions_m()[colony.texel])
                                                    .norm());
            EXPECT_LE(nearest, settings.reach_m);
            if (colony.organism == 1) {
                ++fungi;
                EXPECT_GT(ball.growth.gate()[colony.texel], 0.99F);
            }
        }
    }
    EXPECT_GT(known, 6U);
    EXPECT_GT(fungi, 0U);
}

TEST(Colonies, AreTheSameForTheSameSeedAndGoOnFromSavedState) {
    EXPECT_EQ(colonies_after(6, 6, 3), colonies_after(6, 6, 3));
    GrowthBall ball(64), twin(64);
    Colonies colonies({}, 9), resumed({}, 9);
    colonies.start(ball.growth, wound(Vec3(1, 0, 0), 0));
    colonies.start(ball.growth, wound(Vec3(0, 1, 0), 1));  // waits
    for (int day = 0; day < 4; ++day) {
        ball.growth.advance(24, {});
        colonies.spread(ball.growth);
    }
    resumed.restore(colonies.save());
    twin.growth.restore(ball.growth.save());
    EXPECT_EQ(resumed.waiting_count(), colonies.waiting_count());
    for (int day = 0; day < 4; ++day) {
        ball.growth.advance(24, {});
        colonies.spread(ball.growth);
        twin.growth.advance(24, {});
        resumed.spread(twin.growth);
    }
    EXPECT_EQ(colonies.save(), resumed.save());
    EXPECT_EQ(ball.growth.save(), twin.growth.save());
    Colonies other({}, 10);
    EXPECT_THROW(other.restore(colonies.save()), InputError);
    const auto bytes = colonies.save();
    EXPECT_THROW(resumed.restore(std::span(bytes).first(bytes.size() - 1)), InputError);
}

TEST(Colonies, RefuseWhatCannotBe) {
    EXPECT_NE(message_of([] { Colonies({.propagation = 10}, 1); }).find("0 to 9"), std::string::npos);
    EXPECT_THROW(Colonies({.reach_m = 0}, 1), InputError);
}

TEST(StartingPoints, ArePaintedWhereThePaintIs) {
    GrowthBall ball(64);
    std::vector<float> paint(ball.growth.texel_count(), 0);
    for (std::size_t i = 0; i < paint.size(); ++i)
        if (ball.atlas.covered(i) && ball.atlas.texel_direction(i).z() > 0.8) paint[i] = 1;
    const auto texels = painted_texels(ball.atlas, paint, 50, 3, 0);
    ASSERT_EQ(texels.size(), 50U);
    for (const std::size_t i : texels) EXPECT_GT(paint[i], 0);
    EXPECT_GT(std::vector<std::size_t>(texels).size(), 1U);
    EXPECT_NE(texels.front(), texels.back());
    EXPECT_EQ(texels, painted_texels(ball.atlas, paint, 50, 3, 0));
    EXPECT_NE(texels, painted_texels(ball.atlas, paint, 50, 4, 0));
    std::fill(paint.begin(), paint.end(), 0.0F);
    EXPECT_THROW(painted_texels(ball.atlas, paint, 1, 3, 0), InputError);
}

TEST(StartingPoints, ContactsWetTheSkinAroundThem) {
    const geometry::CubeAtlas atlas(64);
    const auto positions = ball_positions(atlas, 0.035);
    std::vector<float> wetness(atlas.texel_count(), 0);
    wet_around(atlas, positions, Vec3(0, 0, -0.035), 0.005, wetness);
    for (std::size_t i = 0; i < wetness.size(); ++i) {
        if (!atlas.covered(i)) continue;
        const double distance = (positions[i] - Vec3(0, 0, -0.035)).norm();
        if (distance < 0.005) {
            EXPECT_FLOAT_EQ(wetness[i], 1);
        } else if (distance > 0.010) {
            EXPECT_EQ(wetness[i], 0);
        }
    }
    EXPECT_FLOAT_EQ(wetness[atlas.texel_at(Vec3(0, 0, -1))], 1);
}

}  // namespace
}  // namespace windfall::decay
