#include "fracture/crack_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/random_cracks.h"

namespace windfall::fracture {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::vector<Crack> of_rank(const CrackSet& set, CrackRank rank) {
    std::vector<Crack> result;
    std::copy_if(set.cracks.begin(), set.cracks.end(), std::back_inserter(result),
                 [&](const Crack& c) { return c.rank == rank; });
    return result;
}

double turned(double angle) { return angle - kTurn * std::round(angle / kTurn); }

TEST(CrackSet, NoCracksUnlessAsked) {
    const CrackSet set = draw_cracks({});
    EXPECT_TRUE(set.cracks.empty());
    EXPECT_EQ(set.count.asked, 0);
}

TEST(CrackSet, EvenCracksGoAroundOnce) {
    FractureParameters p;
    p.cracks.small.count = 12;
    p.cracks.small.length = 0.1;
    for (p.seed = 1; p.seed <= 20; ++p.seed) {
        const CrackSet set = draw_cracks(p);
        ASSERT_EQ(set.cracks.size(), 12U);
        EXPECT_EQ(set.count.opened, 12);
        double sum = 0;
        for (std::size_t k = 0; k < 12; ++k) {
            double gap = turned(set.cracks[(k + 1) % 12].line - set.cracks[k].line);
            EXPECT_GE(gap, 0.39 * kTurn / 12);
            EXPECT_LE(gap, 1.61 * kTurn / 12);
            sum += gap;
        }
        EXPECT_NEAR(sum, kTurn, 1e-9);
    }
}

TEST(CrackSet, GapsHaveTheMeanThatIsAsked) {
    FractureParameters p;
    p.cracks.medium = {20, 9, 0.3, 0.2, 0.002};
    p.tissue.phloem = 0.02;
    double sum = 0;
    int count = 0;
    for (p.seed = 1; p.seed <= 200; ++p.seed) {
        const CrackSet set = draw_cracks(p);
        ASSERT_EQ(set.count.asked, 20);
        for (std::size_t k = 0; k + 1 < set.cracks.size(); ++k) {
            if (set.cracks[k + 1].index != set.cracks[k].index + 1) continue;
            sum += turned(set.cracks[k + 1].line - set.cracks[k].line);
            ++count;
        }
    }
    EXPECT_NEAR(sum / count * 360 / kTurn, 9, 0.1);
}

TEST(CrackSet, LengthDepthAndWidthHaveTheMeansThatAreAsked) {
    FractureParameters p;
    p.cracks.large = {3, 0, 0.4, 0.3, 0.02};
    p.cracks.tangential = {3, 0, 0.5, 0.2, 0.01};
    for (const CrackRank rank : {CrackRank::Large, CrackRank::Tangential}) {
        FractureParameters one = p;
        (rank == CrackRank::Large ? one.cracks.tangential : one.cracks.large).count = 0;
        const CrackClass& asked = rank == CrackRank::Large ? p.cracks.large : p.cracks.tangential;
        double length = 0, depth = 0, width = 0, count = 0;
        for (one.seed = 1; one.seed <= 400; ++one.seed)
            for (const Crack& c : draw_cracks(one).cracks) {
                const double own = c.radial() ? c.end - c.begin : (c.end - c.begin) * c.line;
                EXPECT_LE(own, 1.5 * asked.length + 1e-12);
                EXPECT_GE(c.depth, 0.5 * asked.depth);
                EXPECT_LE(c.half_width, 1.5 * asked.width);
                length += own;
                depth += c.depth;
                width += c.half_width;
                ++count;
            }
        // 1200 numbers, uniform in 0.5 .. 1.5: the mean's deviation is 0.0083.
        EXPECT_NEAR(count, 1200, 12);
        EXPECT_NEAR(length / count, asked.length, 0.03 * asked.length);
        EXPECT_NEAR(depth / count, asked.depth, 0.03 * asked.depth);
        EXPECT_NEAR(width / count, asked.width, 0.03 * asked.width);
    }
}

TEST(CrackSet, ASingleCrackIsASetOfOne) {
    FractureParameters p;
    p.cracks.tangential.count = 1;
    const CrackSet set = draw_cracks(p);
    ASSERT_EQ(set.cracks.size(), 1U);
    EXPECT_FALSE(set.cracks[0].radial());
    EXPECT_GT(set.cracks[0].line, 0);
}

TEST(CrackSet, OneParameterMovesNothingElse) {
    FractureParameters p;
    p.cracks.large = {4, 0, 0.5, 0.3, 0.02};
    p.cracks.medium = {9, 0, 0.3, 0.2, 0.01};
    p.cracks.small = {30, 0, 0.1, 0.1, 0.004};
    p.cracks.tangential = {3, 0, 0.3, 0.1, 0.01};
    p.cracks.check = true;
    p.cracks.check_angle_deg = 200;
    const CrackSet before = draw_cracks(p);
    FractureParameters moved = p;
    moved.cracks.small.width = 0.0045;
    moved.cracks.small.depth = 0.12;
    const CrackSet after = draw_cracks(moved);
    ASSERT_EQ(before.cracks.size(), after.cracks.size());
    for (std::size_t k = 0; k < before.cracks.size(); ++k) {
        const Crack &a = before.cracks[k], &b = after.cracks[k];
        EXPECT_EQ(a.line, b.line);
        EXPECT_EQ(a.begin, b.begin);
        EXPECT_EQ(a.end, b.end);
        if (a.rank == CrackRank::Small) {
            EXPECT_GT(b.half_width, a.half_width);
        } else {
            EXPECT_EQ(a.half_width, b.half_width);
            EXPECT_EQ(a.depth, b.depth);
        }
    }
    // Another number of small cracks leaves all that have their place before them.
    moved = p;
    moved.cracks.small.count = 31;
    const CrackSet more = draw_cracks(moved);
    for (std::size_t k = 0; before.cracks[k].rank != CrackRank::Small; ++k)
        EXPECT_EQ(before.cracks[k].line, more.cracks[k].line);
}

TEST(CrackSet, CracksKeepApartAndAreCounted) {
    FractureParameters p;
    int shortened = 0, dropped = 0;
    for (std::uint32_t number = 0; number < 150; ++number) {
        p.seed = number;
        test::add_random_cracks(number, p);
        const CrackRoom room{0.03, 0.03, 0.02};
        const CrackSet set = draw_cracks(p, room);
        EXPECT_EQ(set.count.opened, static_cast<int>(set.cracks.size()));
        EXPECT_EQ(set.count.opened + set.count.dropped, set.count.asked);
        shortened += set.count.shortened;
        dropped += set.count.dropped;
        for (std::size_t i = 0; i < set.cracks.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Crack &a = set.cracks[i], &b = set.cracks[j];
                if (a.radial() && b.radial()) {
                    const double apart = std::abs(turned(a.line - b.line));
                    const double shared = std::min(a.end, b.end) - std::max(a.begin, b.begin);
                    // Where they run beside each other they do so at a distance.
                    if (shared > 0) {
                        EXPECT_GE(std::max(a.begin, b.begin) * apart, room.along_ring - 1e-9);
                    }
                } else if (a.radial() != b.radial()) {
                    const Crack &ray = a.radial() ? a : b, &ring = a.radial() ? b : a;
                    const double off = std::abs(turned(ray.line - 0.5 * (ring.begin + ring.end)));
                    const bool within = off < 0.5 * (ring.end - ring.begin);
                    EXPECT_FALSE(within && ray.begin < ring.line && ring.line < ray.end);
                }
            }
    }
    EXPECT_GT(shortened, 0);
    EXPECT_GT(dropped, 0);
}

TEST(CrackSet, OnlyTheCheckLeavesTheWood) {
    FractureParameters p;
    for (std::uint32_t number = 0; number < 60; ++number) {
        test::add_random_cracks(number, p);
        p.tissue.phloem = 0.1;
        for (const Crack& c : draw_cracks(p).cracks) {
            EXPECT_EQ(c.reaches_bark(), c.rank == CrackRank::Check);
            const double outermost = c.radial() ? c.end : c.line;
            EXPECT_LT(outermost, c.rank == CrackRank::Check ? 1.01 : 0.9);
            if (c.rank != CrackRank::Check) {
                const double length = c.radial() ? c.end - c.begin : c.line * (c.end - c.begin);
                const double width = c.radial() ? c.half_width * 0.5 * (c.begin + c.end) : c.half_width;
                EXPECT_LE(width, 0.2 * length + 1e-12);
            }
        }
    }
}

TEST(CrackSet, CheckOpensByTheDifferenceOfShrinkages) {
    FractureParameters p;
    p.species.name = SpeciesName::Ailanthus;
    p.cracks.check = true;
    EXPECT_NEAR(check_opening(p), (0.049 - 0.016) * kTurn * 0.45, 1e-12);
    EXPECT_NEAR(2 * draw_cracks(p).cracks.at(0).half_width, check_opening(p), 1e-12);
    p.species.name = SpeciesName::Custom;
    p.species.shrinkage_tangential = p.species.shrinkage_radial;
    EXPECT_TRUE(draw_cracks(p).cracks.empty());
}

TEST(CrackSet, WetWoodHasFewAndNarrowCracks) {
    FractureParameters p;
    p.cracks.small = {40, 0, 0.1, 0.1, 0.004};
    const CrackSet dry = draw_cracks(p);
    p.species.moisture = Moisture::Wet;
    const CrackSet wet = draw_cracks(p);
    EXPECT_EQ(dry.count.asked, 40);
    EXPECT_EQ(wet.count.asked, 10);
    EXPECT_LT(of_rank(wet, CrackRank::Small)[0].half_width, of_rank(dry, CrackRank::Small)[0].half_width);
}

}  // namespace
}  // namespace windfall::fracture
