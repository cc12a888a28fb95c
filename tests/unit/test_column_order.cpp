#include "drying/column_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace windfall::drying {
namespace {

class ColumnOrders : public testing::TestWithParam<geometry::Lattice> {
  protected:
    geometry::BrickSurface brick = geometry::make_brick_surface(GetParam());
    ColumnOrder order = make_column_order(brick);
};

TEST_P(ColumnOrders, OrdersArePermutations) {
    std::vector<std::int32_t> sorted = order.vertex_of_solver;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], static_cast<int>(i));
    for (std::size_t i = 0; i < sorted.size(); ++i)
        ASSERT_EQ(order.solver_of_vertex[order.vertex_of_solver[i]], static_cast<int>(i));
    std::vector<std::int32_t> quads = order.brick_quad;
    std::sort(quads.begin(), quads.end());
    for (std::size_t i = 0; i < quads.size(); ++i) ASSERT_EQ(quads[i], static_cast<int>(i));
}

TEST_P(ColumnOrders, RangesCoverEverythingOnce) {
    std::int32_t expected = 0;
    for (const auto& colour : order.columns)
        for (const Range& range : colour) {
            ASSERT_EQ(range.begin, expected);
            expected = range.end;
        }
    EXPECT_EQ(expected, order.column_count());
    expected = 0;
    for (const auto& colour : order.quad_ranges)
        for (const Range& range : colour) {
            ASSERT_EQ(range.begin, expected);
            expected = range.end;
        }
    EXPECT_EQ(expected, static_cast<int>(order.quads.size()));
}

TEST_P(ColumnOrders, RangesOfOneColourTouchNoColumnTwice) {
    // A sweep over a range reads and writes its columns and their neighbours.
    for (const auto& colour : order.columns) {
        std::set<std::int32_t> touched;
        std::size_t sum = 0;
        for (const Range& range : colour) {
            std::set<std::int32_t> own;
            for (std::int32_t v = range.begin; v < range.end; ++v) {
                own.insert(v);
                for (std::int32_t e = order.lower_begin[v]; e < order.lower_begin[v + 1]; ++e)
                    own.insert(order.lower_column[e]);
                for (std::int32_t u = order.upper_begin[v]; u < order.upper_begin[v + 1]; ++u)
                    own.insert(order.upper_column[u]);
            }
            sum += own.size();
            touched.insert(own.begin(), own.end());
        }
        EXPECT_EQ(sum, touched.size());
    }
    for (const auto& colour : order.quad_ranges) {
        std::set<std::int32_t> touched;
        std::size_t sum = 0;
        for (const Range& range : colour) {
            std::set<std::int32_t> own;
            for (std::int32_t q = range.begin; q < range.end; ++q)
                own.insert(order.quads[q].begin(), order.quads[q].end());
            sum += own.size();
            touched.insert(own.begin(), own.end());
        }
        EXPECT_EQ(sum, touched.size());
    }
}

TEST_P(ColumnOrders, LowerAndUpperAreTransposesAndHoldEveryPair) {
    std::set<std::pair<int, int>> pairs;
    for (const auto& quad : order.quads)
        for (const auto a : quad)
            for (const auto b : quad)
                if (a > b) pairs.insert({a, b});
    EXPECT_EQ(pairs.size(), order.lower_column.size());
    for (std::int32_t v = 0; v < order.column_count(); ++v)
        for (std::int32_t u = order.upper_begin[v]; u < order.upper_begin[v + 1]; ++u) {
            const std::int32_t row = order.upper_column[u];
            const std::int32_t entry = order.upper_entry[u];
            ASSERT_EQ(order.lower_column[entry], v);
            ASSERT_TRUE(order.lower_begin[row] <= entry && entry < order.lower_begin[row + 1]);
            ASSERT_EQ(pairs.count({row, v}), 1U);
        }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ColumnOrders,
                         testing::Values(geometry::Lattice{3, 3, 3}, geometry::Lattice{8, 8, 8},
                                         geometry::Lattice{24, 40, 24}));

}  // namespace
}  // namespace windfall::drying
