#include "fracture/crack_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random_branch.h"
#include "support/random_cracks.h"

namespace windfall::fracture {
namespace {

/// A log of plain wood without cracks, whose rays are straight.
FractureParameters sound_log(std::int64_t rings, std::int64_t sectors) {
    FractureParameters p;
    p.branch.rings = rings;
    p.branch.sectors = sectors;
    p.branch.length = 1.3;
    p.cracks.irregularity = 0;
    return p;
}

FractureParameters with_check(FractureParameters p) {
    p.species.name = SpeciesName::Ailanthus;
    p.cracks.check = true;
    return p;
}

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

/// Angle from the right to the left wall of the first crack, at a radius and a height.
double opening_at(const CrackShape& shape, double radius, double z) {
    const LatticeCrack& c = shape.section().cracks().at(0);
    const int ring = static_cast<int>(std::lround(radius * shape.section().grid().rings));
    return angle_between(shape.at(ring, c.line, z, CrackSide::Right),
                         shape.at(ring, c.line, z, CrackSide::Left));
}

TEST(CrackShape, WithoutCracksAndWanderingItIsTheLattice) {
    const CrackShape shape(sound_log(20, 36));
    for (int r = 0; r <= 20; ++r)
        for (int s = 0; s < 36; ++s) {
            const double angle = s * std::numbers::pi / 18, radius = r / 20.0;
            const Eigen::Vector2d place = shape.at(r, s, -0.4, CrackSide::Left);
            EXPECT_NEAR(place.x(), radius * std::cos(angle), 1e-6);
            EXPECT_NEAR(place.y(), radius * std::sin(angle), 1e-6);
        }
    EXPECT_NEAR(shape.least_jacobian(9, shape.cell(9, 5, 0)), 0.95, 0.05);
}

TEST(CrackShape, NoCellOfRandomLogsIsTurnedInsideOutAtAnyDepth) {
    int narrowed = 0;
    for (std::uint32_t number = 0; number < 120; ++number) {
        FractureParameters p = test::random_branch(number, 24, 60);
        test::add_random_cracks(number, p);
        const CrackShape shape(p);
        narrowed += shape.count().narrowed;
        const CrackGrid& grid = shape.section().grid();
        for (const double share : {0.0, 0.02, 0.1, 0.4, 1.0})
            for (int r = 0; r < grid.rings; ++r)
                for (int s = 0; s < grid.sectors; ++s)
                    ASSERT_GT(shape.least_jacobian(r, shape.cell(r, s, -share * p.branch.length)), 0)
                        << "recipe " << number << ", ring " << r << ", sector " << s << ", depth " << share;
    }
    EXPECT_GT(narrowed, 50);
}

TEST(CrackShape, CheckOpensAtTheBarkByItsFormula) {
    const FractureParameters p = with_check(sound_log(60, 160));
    const CrackShape shape(p);
    EXPECT_NEAR(opening_at(shape, 1, 0), (0.049 - 0.016) * 2 * std::numbers::pi * 0.45, 1e-9);
    EXPECT_NEAR(opening_at(shape, 0.5, 0), opening_at(shape, 1, 0), 1e-9);  // a wedge
    EXPECT_EQ(shape.count().narrowed, 0);
}

TEST(CrackShape, CheckClosesDownwardsAndTowardsThePith) {
    const FractureParameters p = with_check(sound_log(100, 160));
    const CrackShape shape(p);
    const double whole = opening_at(shape, 1, 0);
    EXPECT_NEAR(opening_at(shape, 1, -0.5 * p.cracks.check_depth), 0.5 * whole, 1e-9);
    EXPECT_NEAR(opening_at(shape, 1, -p.cracks.check_depth), 0, 1e-9);
    EXPECT_LT(opening_at(shape, 0.04, 0), 0.6 * whole);
    EXPECT_NEAR(opening_at(shape, 0.02, 0), 0, 1e-9);
}

TEST(CrackShape, OpeningDoesNotDependOnTheResolution) {
    FractureParameters coarse = sound_log(50, 120), fine = sound_log(150, 360);
    for (FractureParameters* p : {&coarse, &fine}) p->cracks.large = {1, 0, 0.6, 0.4, 0.03};
    for (coarse.seed = fine.seed = 1; coarse.seed <= 5; ++coarse.seed, ++fine.seed) {
        const CrackShape a(coarse), b(fine);
        const Crack& crack = b.section().cracks().at(0).crack;
        for (const double at : {0.3, 0.5, 0.7}) {
            const double radius = crack.begin + at * (crack.end - crack.begin);
            EXPECT_NEAR(opening_at(a, radius, 0), opening_at(b, radius, 0), 0.06 * 2 * crack.half_width);
        }
        const double middle = 0.5 * (crack.begin + crack.end);
        EXPECT_NEAR(opening_at(b, middle, 0), 2 * crack.half_width, 0.02 * 2 * crack.half_width);
        // Wood beside the crack gives way as far off in both.
        EXPECT_EQ(a.section().cracks()[0].reach, b.section().cracks()[0].reach);
    }
}

TEST(CrackShape, TangentialCrackOpensAlongItsRing) {
    FractureParameters p = sound_log(200, 300);
    p.cracks.tangential = {1, 0, 0.6, 0.2, 0.01};
    const CrackShape shape(p);
    const LatticeCrack& c = shape.section().cracks().at(0);
    const int middle = shape.section().grid().wrapped_sector((c.begin + c.end) / 2);
    const double inner = shape.at(c.line, middle, 0, CrackSide::Left).norm();
    const double outer = shape.at(c.line, middle, 0, CrackSide::Right).norm();
    EXPECT_NEAR(outer - inner, 2 * c.crack.half_width, 0.1 * c.crack.half_width);
    EXPECT_NEAR(0.5 * (outer + inner), c.line / 200.0, 1e-6);
    // It closes at its ends, and neither pith nor bark moves.
    for (const int end : {c.begin, c.end})
        EXPECT_NEAR(shape.at(c.line, shape.section().grid().wrapped_sector(end), 0, CrackSide::Left).norm(),
                    c.line / 200.0, 1e-6);
    EXPECT_NEAR(shape.at(200, middle, 0, CrackSide::Left).norm(), 1, 1e-6);
}

TEST(CrackShape, WanderingIsSmallSmoothAndAlongTheFibres) {
    FractureParameters p = sound_log(60, 180);
    p.cracks.irregularity = 0.035;
    const CrackShape straight(sound_log(60, 180)), wandering(p);
    double most = 0, mean = 0, steepest = 0, down = 0;
    for (int r = 1; r <= 60; ++r)
        for (int s = 0; s < 180; ++s) {
            const Eigen::Vector2d shift =
                wandering.at(r, s, 0, CrackSide::Left) - straight.at(r, s, 0, CrackSide::Left);
            const Eigen::Vector2d inside =
                wandering.at(r - 1, s, 0, CrackSide::Left) - straight.at(r - 1, s, 0, CrackSide::Left);
            const Eigen::Vector2d below =
                wandering.at(r, s, -0.1, CrackSide::Left) - straight.at(r, s, -0.1, CrackSide::Left);
            most = std::max(most, shift.norm());
            mean += shift.norm() / (60 * 180);
            steepest = std::max(steepest, (shift - inside).norm() * 60);
            down = std::max(down, (shift - below).norm());
        }
    EXPECT_LT(most, 2.5 * 0.035);
    EXPECT_GT(mean, 0.2 * 0.035);
    EXPECT_LT(steepest, 0.9);
    EXPECT_LT(down, 0.3 * 0.035);
}

TEST(CrackShape, CracksThatWouldPressTheWoodTooMuchAreNarrowed) {
    FractureParameters p = sound_log(60, 240);
    p.cracks.medium = {24, 0, 0.5, 0.3, 0.1};
    const CrackShape shape(p);
    EXPECT_GT(shape.count().narrowed, 10);
    for (int s = 0; s < 240; ++s) EXPECT_GT(shape.least_jacobian(30, shape.cell(30, s, 0)), 0.04);
    p.cracks.medium.width = 0.003;
    EXPECT_EQ(CrackShape(p).count().narrowed, 0);
}

}  // namespace
}  // namespace windfall::fracture
