// The break: topology, fit of the two ends, and the statistics of Yang et al. 2019.
#include "fracture/break_ends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "fracture/bark_walls.h"
#include "fracture/broken_branch.h"
#include "support/branch_checks.h"
#include "support/flat_break.h"
#include "support/message_of.h"
#include "support/random_branch.h"

namespace windfall::fracture {
namespace {

constexpr double kPi = std::numbers::pi;

/// Levels of an ailanthus.
FractureParameters bundled(std::int64_t rings, std::int64_t sectors) {
    FractureParameters p;
    p.branch.rings = rings;
    p.branch.sectors = sectors;
    p.branch.layers = 6;
    p.fracture.tilt_deg = 12;
    p.bundles.radial = {0.5, 0.24, 0.06};
    p.bundles.angular = {0.9, 0.42, 0.09};
    p.bundles.amplitude = {0.6, 0.5, 0.3};
    p.bundles.slope = {0.32, 0.35, 1.5};
    return p;
}

double cell_height(const BreakEnds& ends, int ring, int sector) {
    double sum = 0;
    for (const std::int32_t v : ends.cells.of(ring, sector))
        sum += ends.stub.positions[static_cast<std::size_t>(v)].z() / 4;
    return sum;
}

/// Heights over a grid of places in the cross-section, the same places at every resolution.
std::vector<double> heights_at_places(const BreakEnds& ends) {
    std::vector<double> heights;
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 64; ++j) {
            const double radius = 0.1 + 0.75 * (i + 0.5) / 16;
            heights.push_back(cell_height(ends, static_cast<int>(radius * ends.cells.rings),
                                          static_cast<int>((j + 0.5) / 64 * ends.cells.sectors)));
        }
    return heights;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double ma = 0, mb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ma += a[i] / static_cast<double>(a.size());
        mb += b[i] / static_cast<double>(b.size());
    }
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - ma) * (b[i] - mb);
        aa += (a[i] - ma) * (a[i] - ma);
        bb += (b[i] - mb) * (b[i] - mb);
    }
    return ab / std::sqrt(aa * bb);
}

/// Smallest corner Jacobian of a cell in the plan, over the product of its sides.
double worst_corner(const BreakEnds& ends) {
    double worst = 1;
    for (int r = 1; r < ends.cells.rings; ++r)
        for (int s = 0; s < ends.cells.sectors; ++s) {
            const auto& v = ends.cells.of(r, s);
            for (std::size_t k = 0; k < 4; ++k) {
                const auto at = [&](std::size_t i) {
                    return ends.stub.positions[static_cast<std::size_t>(v[i & 3U])]
                        .head<2>()
                        .cast<double>()
                        .eval();
                };
                const Eigen::Vector2d a = at(k + 1) - at(k), b = at(k + 3) - at(k);
                worst = std::min(worst, (a.x() * b.y() - a.y() * b.x()) / (a.norm() * b.norm()));
            }
        }
    return worst;
}

TEST(BreakEnds, RandomBranchesAreClosedAndFitWithoutOverlap) {
    BreakEnds ends;
    BreakWorkspace workspace;
    int refused = 0;
    for (std::uint32_t number = 0; number < 120; ++number) {
        FractureParameters p = resolved(test::random_branch(number, 24, 60));
        p.output.piece = PiecePlace::Above;
        p.branch.bend_deg = 0;
        try {
            make_break_ends(p, ends, workspace);
            ASSERT_GT(worst_corner(ends), 0) << "recipe " << number;
            make_branch(p, ends, workspace);
        } catch (const InputError&) {
            ++refused;
            continue;
        }
        ASSERT_FALSE(test::has_inverted_cell(ends)) << "recipe " << number;
        ASSERT_EQ(test::complaint_about(ends.stub), "") << "recipe " << number;
        ASSERT_EQ(test::complaint_about(ends.piece), "") << "recipe " << number;
        ASSERT_GT(test::volume(ends.stub), 0) << "recipe " << number;
        ASSERT_GT(test::volume(ends.piece), 0) << "recipe " << number;
        for (int k = 0; k < 6; ++k) {
            const double radius = 0.07 + 0.17 * k, angle = 2.4 * k + number;
            ASSERT_LT(test::overlap_along_z(ends.stub, ends.piece, radius * std::cos(angle),
                                            radius * std::sin(angle)),
                      1e-4)
                << "recipe " << number;
        }
    }
    EXPECT_LT(refused, 30);
}

/// Thorns stand up to the last ring but one, where deep furrows of small plates go through them.
TEST(BreakEnds, ThornsInTheBarkFitUnderDeepFurrows) {
    FractureParameters p = flat(20, 20);
    p.tissue = {0, 0.3, 0.3};
    p.branch.taper = 0;
    p.branch.bark_relief = 0.3;
    p.branch.bark_scale = 4.5;
    p.thorns.phloem_length = 3;
    p.thorns.phloem_probability = 0.6;
    p.thorns.skew = 0.1;
    p.output.piece = PiecePlace::Above;
    BreakEnds ends;
    BreakWorkspace workspace;
    for (p.seed = 1; p.seed <= 4; ++p.seed) {
        make_branch(p, ends, workspace);
        EXPECT_FALSE(test::has_inverted_cell(ends)) << "seed " << p.seed;
        for (int k = 0; k < 300; ++k) {
            const double radius = 0.6 + 0.4 * std::fmod(0.618 * k, 1.0), angle = 2.4 * k;
            ASSERT_LT(test::overlap_along_z(ends.stub, ends.piece, radius * std::cos(angle),
                                            radius * std::sin(angle)),
                      1e-4)
                << "seed " << p.seed;
        }
    }
}

TEST(BreakEnds, BendsAsLittleAsCanBe) {
    BreakEnds straight, bent;
    BreakWorkspace workspace;
    FractureParameters p = bundled(20, 40);
    make_branch(p, straight, workspace);
    p.branch.bend_deg = 1e-6;
    make_branch(p, bent, workspace);
    ASSERT_EQ(straight.stub.positions.size(), bent.stub.positions.size());
    for (std::size_t v = 0; v < bent.stub.positions.size(); ++v)
        ASSERT_LT((bent.stub.positions[v] - straight.stub.positions[v]).norm(), 1e-5F);
    p.branch.bend_deg = 40;
    p.branch.layers = 2;
    p.branch.length = 60;
    EXPECT_THAT(message_of([&] { make_branch(p, bent, workspace); }), testing::HasSubstr("branch.layers"));
    p.branch.layers = 40;
    EXPECT_NO_THROW(make_branch(p, bent, workspace));
    p.low = {-19, 0, 360, 0.5};
    p.branch.length = p.branch.piece_length = 4;
    EXPECT_THAT(message_of([&] { make_branch(p, bent, workspace); }), testing::HasSubstr("radii high"));
}

TEST(BreakEnds, AsksWhatCannotBeScaledAndWhatWouldTurnInsideOut) {
    BreakEnds ends;
    BreakWorkspace workspace;
    FractureParameters p = flat(20, 40);
    p.fracture.height_from = HeightSource::Asked;
    p.fracture.mean_height = 3;
    EXPECT_THAT(message_of([&] { make_break_ends(p, ends, workspace); }), testing::HasSubstr("is flat"));
    p = bundled(20, 40);
    p.fracture.height_from = HeightSource::Asked;
    p.fracture.mean_height = 8;
    p.branch.taper = 0.1;
    EXPECT_NO_THROW(check(p)) << "the height is known only once the surface is there";
    EXPECT_THAT(message_of([&] { make_branch(p, ends, workspace); }), testing::HasSubstr("branch.taper"));
    p.branch.taper = 0;
    EXPECT_NO_THROW(make_branch(p, ends, workspace));
    p.bundles.skew = 10;  // few bundles stand out, very far
    p.bundles.amplitude = {0, 0, 20};
    p.bundles.slope = {0, 0, 0};
    p.fracture.tilt_deg = 0;
    p.fracture.mean_height = 40;
    EXPECT_THAT(message_of([&] { make_branch(p, ends, workspace); }), testing::HasSubstr("radii high"));
}

TEST(BreakEnds, TogetherTheyAreTheWholeBranch) {
    FractureParameters p = bundled(30, 60);
    p.fringe.strands = 40;
    p.branch.taper = p.branch.outline = p.branch.bark_relief = 0;
    p.output.piece = PiecePlace::Above;
    p.tissue.phloem = 0.1;
    BreakEnds ends;
    BreakWorkspace workspace;
    make_branch(p, ends, workspace);
    double low = 0, high = 0;
    for (const Vector3f& v : ends.stub.positions) low = std::min<double>(low, v.z());
    for (const Vector3f& v : ends.piece.positions) high = std::max<double>(high, v.z());
    // Thorns stand in holes that are a little larger, and the cross-section is a polygon.
    const double whole = kPi * (high - low);
    EXPECT_NEAR(test::volume(ends.stub) + test::volume(ends.piece), whole, 0.01 * whole);
}

TEST(BreakEnds, NormalsOfThePieceAreThoseOfItsOwnFaces) {
    for (const PiecePlace place : {PiecePlace::Above, PiecePlace::Beside}) {
        FractureParameters p = bundled(30, 60);
        p.fringe.strands = 40;
        p.thorns.sapwood_length = 1;
        p.thorns.sapwood_probability = 0.1;
        p.output.piece = place;
        BreakEnds ends;
        BreakWorkspace workspace;
        make_branch(p, ends, workspace);
        BranchMesh again = ends.piece;
        compute_normals(again);
        for (std::size_t f = 0; f < again.faces.size(); ++f)
            ASSERT_LT((again.face_normals[f] - ends.piece.face_normals[f]).norm(), 2e-2F) << f;
        for (std::size_t v = 0; v < again.positions.size(); ++v)
            ASSERT_LT((again.normals[v] - ends.piece.normals[v]).norm(), 2e-2F) << v;
    }
}

TEST(BreakEnds, ThornCountsFollowTheirProbability) {
    FractureParameters p = flat(60, 120);
    p.thorns.heartwood_length = 0.3;
    p.thorns.heartwood_probability = 0.2;
    const double sites = 58 * 120;  // neither the pith's ring nor the outermost one has thorns
    const double mean = sites * 0.2, deviation = std::sqrt(sites * 0.2 * 0.8);
    double sum = 0;
    for (int seed = 1; seed <= 8; ++seed) {
        p.seed = seed;
        const BreakEnds ends = ends_of(p);
        EXPECT_NEAR(ends.stub_thorns, mean, 4 * deviation);
        // The piece has thorns where the stub has none.
        EXPECT_NEAR(ends.piece_thorns, mean * 0.8, 4 * deviation);
        sum += ends.stub_thorns;
    }
    EXPECT_NEAR(sum, 8 * mean, 3 * std::sqrt(8.0) * deviation);
}

TEST(BreakEnds, DuctileZoneHasItsOwnThorns) {
    FractureParameters p = flat(40, 80);
    p.ductile = {2, 0.5, 350, 60, 0.5};
    const BreakEnds ends = ends_of(p);
    // 60 of 360 degrees, rings 20 .. 38 of 40
    const double sites = 60.0 / 360 * 80 * 19;
    EXPECT_NEAR(ends.stub_thorns, sites * 0.5, 4 * std::sqrt(sites * 0.25) + 20);
    for (std::size_t v = static_cast<std::size_t>(ends.surface_vertices); v < ends.stub.positions.size();
         ++v) {
        const double angle = std::atan2(ends.stub.positions[v].y(), ends.stub.positions[v].x()) * 180 / kPi;
        ASSERT_LT(std::abs(std::remainder(angle + 10, 360)), 34);
    }
}

TEST(BreakEnds, SectorsWrapThrough360Degrees) {
    FractureParameters p = flat(20, 72);
    p.high = {1.5, 350, 60, 0.4};
    const BreakEnds ends = ends_of(p);
    for (int s = 0; s < 72; ++s) {
        const double away = std::abs(std::remainder((s + 0.5) * 5 - 350, 360));
        if (std::abs(away - 30) < 3) continue;
        EXPECT_NEAR(cell_height(ends, 15, s), away < 30 ? 1.5 : 0, 1e-5) << s;
        EXPECT_NEAR(cell_height(ends, 5, s), 0, 1e-5) << s;
    }
}

TEST(BreakEnds, TiltIsThePlaneOfItsAngle) {
    FractureParameters p = flat(20, 40);
    p.fracture.tilt_deg = 65;
    p.fracture.tilt_direction_deg = 30;
    const BreakEnds ends = ends_of(p);
    const double slope = std::tan(65 * kPi / 180);
    for (const Vector3f& v : ends.stub.positions)
        ASSERT_NEAR(v.z(), slope * (v.x() * std::cos(kPi / 6) + v.y() * std::sin(kPi / 6)), 1e-5);
}

/// With bundles each of the finest ones is a particle.
TEST(BreakEnds, ThornCountsOfBundlesFollowTheirProbability) {
    FractureParameters p = flat(60, 180);
    p.bundles.radial = {0.1};
    p.bundles.angular = {0.1};
    p.bundles.amplitude = {0.05};
    p.bundles.slope = {0};
    p.bundles.warp = 0;
    double stub = 0, piece = 0, sites = 0;
    for (p.seed = 1; p.seed <= 12; ++p.seed) {
        p.thorns.heartwood_length = 0.2;
        p.thorns.heartwood_probability = 1;
        sites += ends_of(p).stub_thorns;  // all of them
        p.thorns.heartwood_probability = 0.2;
        const BreakEnds ends = ends_of(p);
        stub += ends.stub_thorns;
        piece += ends.piece_thorns;
    }
    EXPECT_GT(sites, 12 * 200);
    EXPECT_NEAR(stub, 0.2 * sites, 4 * std::sqrt(sites * 0.2 * 0.8));
    EXPECT_NEAR(piece, 0.16 * sites, 4 * std::sqrt(sites * 0.16 * 0.84));
}

TEST(BreakEnds, MeanHeightIsTheAskedOne) {
    for (const double asked : {0.5, 3.0, 6.68}) {
        FractureParameters p = bundled(60, 120);
        p.fracture.height_from = HeightSource::Asked;
        p.fracture.mean_height = asked;
        const BreakEnds ends = ends_of(p);
        double sum = 0, area = 0, lowest = 1e9;
        for (int r = 0; r < ends.cells.rings; ++r)
            for (int s = 0; s < ends.cells.sectors; ++s) {
                sum += (r + 0.5) * cell_height(ends, r, s);
                area += r + 0.5;
            }
        for (const Vector3f& v : ends.stub.positions) lowest = std::min<double>(lowest, v.z());
        EXPECT_NEAR(sum / area - lowest, asked, 0.02 * asked);
        EXPECT_NEAR(ends.mean_height, asked, 1e-9);
    }
}

TEST(BreakEnds, SameSeedSameBitsAnotherSeedAnotherBreak) {
    const FractureParameters p = bundled(40, 80);
    BreakEnds first = ends_of(p), second;
    BreakWorkspace workspace;
    FractureParameters other = test::random_branch(3, 50, 90);
    make_break_ends(other, second, workspace);  // what the workspace held before does not matter
    make_break_ends(p, second, workspace);
    EXPECT_EQ(first.stub.faces, second.stub.faces);
    ASSERT_EQ(first.piece.positions.size(), second.piece.positions.size());
    for (std::size_t v = 0; v < first.piece.positions.size(); ++v)
        ASSERT_EQ(first.piece.positions[v], second.piece.positions[v]);
    other = p;
    other.seed = 2;
    EXPECT_LT(correlation(heights_at_places(first), heights_at_places(ends_of(other))), 0.7);
}

TEST(BreakEnds, ASliderDeformsTheBreakInsteadOfReplacingIt) {
    const FractureParameters p = bundled(80, 240);
    const auto before = heights_at_places(ends_of(p));
    const auto correlated = [&](auto change) {
        FractureParameters q = p;
        change(q);
        return correlation(before, heights_at_places(ends_of(q)));
    };
    EXPECT_GT(correlated([](auto& q) { q.bundles.amplitude = {0.63, 0.525, 0.315}; }), 0.999);
    EXPECT_GT(correlated([](auto& q) { q.bundles.warp *= 1.1; }), 0.95);
    EXPECT_GT(correlated([](auto& q) { q.thorns.sapwood_length = 1, q.thorns.sapwood_probability = 0.01; }),
              0.8);
    // One bundle more or less in a ring splits or joins its neighbours alone.
    EXPECT_GT(correlated([](auto& q) { q.bundles.angular = {0.927, 0.4326, 0.0927}; }), 0.9);
    EXPECT_GT(correlated([](auto& q) { q.roughness.heartwood *= 2; }), 0.99);
}

/// Each particle keeps its number when thorns and strands part others from their neighbours.
TEST(BreakEnds, WhiteNoiseStaysWithItsParticle) {
    FractureParameters p = flat(40, 120);
    p.roughness.octaves = 0;
    p.roughness.heartwood = 0.3;
    p.roughness.white_octaves = 4;
    const auto before = heights_at_places(ends_of(p));
    EXPECT_GT(*std::max_element(before.begin(), before.end()), 0.1);
    const auto correlated = [&](auto change) {
        FractureParameters q = p;
        change(q);
        return correlation(before, heights_at_places(ends_of(q)));
    };
    EXPECT_GT(correlated([](auto& q) { q.fringe.strands = 100, q.fringe.strand_length = 0.01; }), 0.999);
    EXPECT_GT(
        correlated([](auto& q) { q.thorns.heartwood_length = 0.01, q.thorns.heartwood_probability = 0.1; }),
        0.999);
    EXPECT_GT(correlated([](auto& q) {
                  q.bundles.radial = q.bundles.angular = {0.2};
                  q.bundles.amplitude = q.bundles.slope = {1e-3};
                  q.bundles.warp = 0.1;
              }),
              0.99);
    EXPECT_GT(correlated([](auto& q) { q.roughness.heartwood *= 2; }), 0.999);
}

TEST(BreakEnds, ThornsStayWhereTheyAreWhenTheirLengthChanges) {
    FractureParameters p = flat(30, 60);
    p.thorns.heartwood_length = 0.5;
    p.thorns.heartwood_probability = 0.1;
    const BreakEnds first = ends_of(p);
    p.thorns.heartwood_length = 1.5;
    const BreakEnds longer = ends_of(p);
    ASSERT_EQ(first.stub.positions.size(), longer.stub.positions.size());
    for (std::size_t v = 0; v < first.stub.positions.size(); ++v)
        ASSERT_LT((first.stub.positions[v].head<2>() - longer.stub.positions[v].head<2>()).norm(), 1e-6F);
    p.thorns.heartwood_probability = 0.15;
    EXPECT_GT(ends_of(p).stub_thorns, first.stub_thorns);
}

TEST(BreakEnds, CoarseAndFineLatticesShowTheSameBreak) {
    const auto fine = heights_at_places(ends_of(bundled(200, 400)));
    EXPECT_GT(correlation(heights_at_places(ends_of(bundled(40, 120))), fine), 0.75);
    // The paper's own: 40 x 40 against 200 x 200.
    const auto paper_fine = heights_at_places(ends_of(bundled(200, 200)));
    EXPECT_GT(correlation(heights_at_places(ends_of(bundled(40, 40))), paper_fine), 0.6);
}

}  // namespace
}  // namespace windfall::fracture
