// Ten thousand branches drawn at random from the ranges of the parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "fracture/broken_branch.h"
#include "support/branch_checks.h"
#include "support/random_branch.h"

namespace windfall::fracture {
namespace {

/// What is wrong with the branch of this recipe; empty when nothing is.
std::string complaint_about(const FractureParameters& p, std::uint32_t number, BreakEnds& ends,
                            BreakWorkspace& workspace) {
    make_branch(p, ends, workspace);
    const bool is_straight = p.branch.bend_deg == 0, has_piece = p.output.piece != PiecePlace::Hidden;
    if (is_straight && test::has_inverted_cell(ends)) return "a cell turned inside out";
    if (const std::string text = test::complaint_about(ends.stub); !text.empty()) return "stub: " + text;
    if (!(test::volume(ends.stub) > 0)) return "stub turned inside out";
    if (!has_piece) return "";
    if (const std::string text = test::complaint_about(ends.piece); !text.empty()) return "piece: " + text;
    if (!(test::volume(ends.piece) > 0)) return "piece turned inside out";
    const bool fits = p.output.piece == PiecePlace::Above;
    for (int k = 0; k < 2 && is_straight && fits; ++k) {
        const double radius = std::fmod(0.37 * (number + 1) + 0.5 * k, 1.0), angle = 2.4 * number + k;
        const double shared =
            test::overlap_along_z(ends.stub, ends.piece, radius * std::cos(angle), radius * std::sin(angle));
        if (!(shared < 1e-4)) return "overlap of " + std::to_string(shared);
    }
    return "";
}

TEST(RandomBranches, TenThousandAreClosedManifoldOrientedAndFit) {
    BreakEnds ends;
    BreakWorkspace workspace;
    int refused = 0;
    for (std::uint32_t number = 0; number < 10000; ++number) {
        const bool large = number % 100 == 0;
        for (std::uint32_t draw = number;; draw += 100000) {
            const FractureParameters p =
                resolved(test::random_branch(draw, large ? 120 : 16, large ? 200 : 40));
            try {
                ASSERT_EQ(complaint_about(p, draw, ends, workspace), "") << "recipe " << draw;
                break;
            } catch (const InputError&) {
                ++refused;  // what only the surface itself tells: too high, or flat and to be scaled
            }
        }
    }
    EXPECT_LT(refused, 5000);
}

}  // namespace
}  // namespace windfall::fracture
