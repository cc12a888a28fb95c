// Ten thousand branches drawn at random from the ranges of the parameters.
#include <gtest/gtest.h>

#include <cmath>

#include "fracture/broken_branch.h"
#include "support/branch_checks.h"
#include "support/random_branch.h"

namespace windfall::fracture {
namespace {

/// Whether a cell of the broken surface is turned inside out in the plan.
bool has_inverted_cell(const BreakEnds& ends) {
    for (int r = 1; r < ends.cells.rings; ++r)
        for (int s = 0; s < ends.cells.sectors; ++s) {
            const auto& v = ends.cells.of(r, s);
            for (std::size_t k = 0; k < 4; ++k) {
                const auto at = [&](std::size_t i) {
                    const Vector3f& p = ends.stub.positions[static_cast<std::size_t>(v[i & 3U])];
                    return Eigen::Vector2d(p.x(), p.y());
                };
                const Eigen::Vector2d a = at(k + 1) - at(k), b = at(k + 3) - at(k);
                if (!(a.x() * b.y() - a.y() * b.x() > 0)) return true;
            }
        }
    return false;
}

TEST(RandomBranches, TenThousandAreClosedManifoldOrientedAndFit) {
    BreakEnds ends;
    BreakWorkspace workspace;
    for (std::uint32_t number = 0; number < 10000; ++number) {
        FractureParameters p = test::random_branch(number, 16, 40);
        if (number % 100 == 0) p = test::random_branch(number, 120, 200);
        check(p);
        make_break_ends(p, ends, workspace);
        ASSERT_FALSE(has_inverted_cell(ends)) << "recipe " << number;
        make_branch(p, ends, workspace);
        ASSERT_EQ(test::complaint_about(ends.stub), "") << "recipe " << number;
        ASSERT_EQ(test::complaint_about(ends.piece), "") << "recipe " << number;
        for (int k = 0; k < 2; ++k) {
            const double radius = std::fmod(0.37 * (number + 1) + 0.5 * k, 1.0), angle = 2.4 * number + k;
            ASSERT_LT(test::overlap_along_z(ends.stub, ends.piece, radius * std::cos(angle),
                                            radius * std::sin(angle)),
                      1e-4)
                << "recipe " << number;
        }
    }
}

}  // namespace
}  // namespace windfall::fracture
