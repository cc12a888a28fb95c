#include "decay/body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "decay/body_measure.h"
#include "decay/body_neighbours.h"
#include "support/body_fruit.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

using ::testing::HasSubstr;

/// Coarse enough for a test, fine enough to wrinkle.
BodySettings coarse(double firmness, double thickness) {
    BodySettings s;
    s.firmness = firmness;
    s.thickness = thickness;
    s.skin_cells = 16;
    s.flesh_cells = 5;
    s.flesh_layers = 4;
    return s;
}

Body settled(const SurfaceFunction& surface, const BodySettings& settings) {
    Body body(surface, settings);
    body.settle({});
    return body;
}

/// Loses `loss` over `frames` frames, evenly, softening as it goes; rot by vertex grows with it.
void age(Body& body, double loss, int frames, const std::vector<float>& rot = {}) {
    std::vector<float> now(rot.size());
    for (int f = 1; f <= frames; ++f) {
        const double share = static_cast<double>(f) / frames;
        for (std::size_t i = 0; i < rot.size(); ++i) now[i] = rot[i] * static_cast<float>(share);
        body.advance({.water_fraction_lost = loss * share, .progress = share, .rot = now});
    }
}

/// Rot around a direction.
std::vector<float> spot(const Body& body, const geometry::Vec3& at) {
    std::vector<float> rot;
    for (const auto& d : body.directions())
        rot.push_back(
            static_cast<float>(std::exp(-std::pow(std::acos(std::clamp(d.dot(at), -1.0, 1.0)) / 0.4, 2))));
    return rot;
}

double motion_rms_m(const std::vector<Eigen::Vector3f>& a, const std::vector<Eigen::Vector3f>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.size()));
}

void expect_sound(const Body& body, const std::string& what) {
    EXPECT_GE(body.lowest_m(), -1e-6) << what;
    EXPECT_LE(body.lowest_m(), 2e-4) << what;
    for (const auto& x : body.skin()) ASSERT_TRUE(x.allFinite()) << what;
}

TEST(Body, StandsForEveryFirmnessThicknessAndLoss) {
    for (const double firmness : {1.0, 50.0, 100.0})
        for (const double thickness : {1.0, 100.0})
            for (const double loss : {0.05, 0.6, 0.9}) {
                auto settings = coarse(firmness, thickness);
                settings.skin_cells = 10;
                settings.softening = 0.025;
                Body body = settled(test::body_tomato(), settings);
                const double fresh = body.height_m();
                age(body, loss, 40, spot(body, geometry::Vec3(0.8, 0, 0.6)));
                const std::string what = "firmness " + std::to_string(firmness) + ", thickness " +
                                         std::to_string(thickness) + ", loss " + std::to_string(loss);
                expect_sound(body, what);
                // The softest flesh may be crushed at its foot when nine tenths go in forty frames.
                if (loss < 0.9 || firmness > 1) {
                    EXPECT_EQ(body.inverted(), 0) << what;
                }
                EXPECT_GT(body.height_m(), 0.25 * std::cbrt(1 - loss) * fresh) << what;
                EXPECT_LT(body.height_m(), 1.05 * fresh) << what;
            }
}

TEST(Body, FirmFruitKeepsTheVolumeThatTheLedgerAsksFor) {
    for (const double loss : {0.1, 0.35, 0.8}) {
        auto settings = coarse(100, 20);
        settings.softening = 1;
        Body body = settled(test::body_apple(), settings);
        const double fresh = body.volume_m3();
        age(body, loss, 100);
        EXPECT_NEAR(body.volume_m3() / fresh / (1 - loss), 1, 0.02) << loss;
    }
}

TEST(Body, TomatoSagsWhereAnAppleStands) {
    auto soft = coarse(50, 20);
    soft.softening = 1.0 / 40;
    auto firm = coarse(80, 30);
    firm.softening = 1.0 / 8;
    Body tomato = settled(test::body_tomato(), soft);
    Body apple = settled(test::body_apple(), firm);
    const double tomato_fresh = tomato.height_m();
    const double apple_fresh = apple.height_m();
    age(tomato, 0.35, 100);
    age(apple, 0.35, 100);
    const double shrunk = std::cbrt(0.65);
    EXPECT_LT(tomato.height_m(), 0.95 * shrunk * tomato_fresh);
    EXPECT_GT(tomato.height_m(), 0.6 * shrunk * tomato_fresh);
    EXPECT_GT(apple.height_m(), 0.98 * shrunk * apple_fresh);
}

TEST(Body, SinksInWhereItRots) {
    Body sound = settled(test::body_apple(), coarse(80, 30));
    Body rotten = settled(test::body_apple(), coarse(80, 30));
    const geometry::Vec3 at = geometry::Vec3(1, 0, 0.1).normalized();
    age(sound, 0.1, 100);
    age(rotten, 0.1, 100, spot(rotten, at));
    double in = 0;
    double weight = 0;
    double elsewhere = 0;
    for (std::size_t i = 0; i < sound.skin().size(); ++i) {
        const double sunk = (sound.skin()[i] - rotten.skin()[i]).cast<double>().dot(at);
        if (sound.directions()[i].dot(at) > 0.97) {
            in += sunk;
            weight += 1;
        } else if (sound.directions()[i].dot(at) < 0) {
            elsewhere = std::max(elsewhere, std::abs(sunk));
        }
    }
    ASSERT_GT(weight, 3);
    EXPECT_GT(in / weight, 2e-3);
    EXPECT_LT(elsewhere, 1e-3);
}

TEST(Body, ComesToRestWhenNothingChanges) {
    Body body = settled(test::body_apple(), coarse(80, 30));
    age(body, 0.3, 60);
    std::vector<double> motion;
    for (int f = 0; f < 60; ++f) {
        const auto before = body.skin();
        body.advance({.water_fraction_lost = 0.3, .progress = 1});
        motion.push_back(motion_rms_m(before, body.skin()));
    }
    EXPECT_LT(motion.back(), 5e-6);
    EXPECT_LT(motion.back(), 0.2 * motion.front());
}

TEST(Body, FleshLiesUnderItsSkinByTheThickness) {
    Body body = settled(test::body_tomato(), coarse(50, 40));
    age(body, 0.3, 80);
    const MeasuredSurface skin(body.skin(), body.faces(), 0.01F);
    int below = 0;
    for (const auto& x : body.flesh()) {
        const double depth = -skin.signed_distance_m(x);
        EXPECT_GT(depth, 0);
        if (depth > 0.3 * body.skin_thickness_m()) ++below;
    }
    EXPECT_GT(below, 0.95 * static_cast<double>(body.flesh().size()));
    EXPECT_NEAR(body.skin_thickness_m(), 0.53e-3, 1e-9);
}

TEST(Body, DoesNotCrossItself) {
    Body body = settled(test::body_tomato(), coarse(50, 20));
    const double fresh_area = body.area_m2();
    age(body, 0.35, 150, spot(body, geometry::Vec3(0.8, 0, 0.6)));
    EXPECT_EQ(body.crossing_edges(), 0);
    // It has wrinkled: more area than a smooth fruit of its volume's share.
    EXPECT_GT(body.area_m2(), 1.02 * std::pow(0.65, 2.0 / 3) * fresh_area);
}

TEST(Body, SameBitsOnAnyNumberOfThreads) {
    std::vector<std::vector<std::byte>> states;
    for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        Body body = settled(test::body_tomato(), coarse(50, 20));
        age(body, 0.2, 40, spot(body, geometry::Vec3(0, 0.8, 0.6)));
        states.push_back(body.save());
    }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(states[0], states[2]);
}

TEST(Body, GoesOnToTheSameBitsFromASavedState) {
    const auto load = [](int frame) {
        return BodyLoad{.water_fraction_lost = 0.004 * frame, .progress = 0.01 * frame};
    };
    Body body = settled(test::body_tomato(), coarse(50, 20));
    // One state between factors, one while the next factor is being made.
    std::vector<std::pair<int, std::vector<std::byte>>> saved;
    for (int f = 1; f <= 60; ++f) {
        body.advance(load(f));
        if (f == 3 || f == 28 || f == 40) saved.emplace_back(f, body.save());
    }
    for (const auto& [frame, state] : saved) {
        Body again(test::body_tomato(), coarse(50, 20));
        again.restore(state);
        EXPECT_EQ(again.rest(), body.rest());
        for (int f = frame + 1; f <= 60; ++f) again.advance(load(f));
        EXPECT_EQ(again.save(), body.save()) << frame;
        EXPECT_EQ(again.flesh(), body.flesh());
    }
}

TEST(Body, RefusesWhatCannotBe) {
    auto settings = coarse(50, 20);
    settings.firmness = 0;
    EXPECT_THAT(message_of([&] { Body(test::body_tomato(), settings); }),
                HasSubstr("firmness must be 1 to 100"));
    settings = coarse(50, 20);
    settings.flesh_cells = 20;
    EXPECT_THAT(message_of([&] { Body(test::body_tomato(), settings); }), HasSubstr("skin_cells"));
    Body body(test::body_tomato(), coarse(50, 20));
    EXPECT_THAT(message_of([&] { body.advance({.water_fraction_lost = 1.2}); }),
                HasSubstr("water_fraction_lost"));
    const std::vector<float> short_rot(7);
    EXPECT_THAT(message_of([&] { body.advance({.rot = short_rot}); }), HasSubstr("7 values for 1538"));
    auto state = body.save();
    Body other(test::body_tomato(), [] {
        auto s = coarse(50, 20);
        s.skin_cells = 14;
        return s;
    }());
    EXPECT_THAT(message_of([&] { other.restore(state); }), HasSubstr("another body"));
    state.resize(state.size() / 2);
    EXPECT_THAT(message_of([&] { body.restore(state); }), HasSubstr("another body"));
    EXPECT_THAT(message_of([&] { body.restore(std::vector<std::byte>(100)); }), HasSubstr("another version"));
}

}  // namespace
}  // namespace windfall::decay
