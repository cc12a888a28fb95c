#include "drying/column_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace windfall::drying {
namespace {

class ColumnOrders : public testing::TestWithParam<geometry::Lattice> {
  protected:
    geometry::BrickSurface m_brick = geometry::make_brick_surface(GetParam());
    ColumnOrder m_order = make_column_order(m_brick);
};

TEST_P(ColumnOrders, OrdersArePermutations) {
    std::vector<std::int32_t> sorted = m_order.vertex_of_solver;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], static_cast<int>(i));
    for (std::size_t i = 0; i < sorted.size(); ++i)
        ASSERT_EQ(m_order.solver_of_vertex[m_order.vertex_of_solver[i]], static_cast<int>(i));
    std::vector<std::int32_t> quads = m_order.brick_quad;
    std::sort(quads.begin(), quads.end());
    for (std::size_t i = 0; i < quads.size(); ++i) ASSERT_EQ(quads[i], static_cast<int>(i));
}

TEST_P(ColumnOrders, RangesCoverEverythingOnce) {
    std::int32_t expected = 0;
    for (const auto& colour : m_order.columns)
        for (const Range& range : colour) {
            ASSERT_EQ(range.begin, expected);
            expected = range.end;
        }
    EXPECT_EQ(expected, m_order.column_count());
    expected = 0;
    for (const auto& colour : m_order.quad_ranges)
        for (const Range& range : colour) {
            ASSERT_EQ(range.begin, expected);
            expected = range.end;
        }
    EXPECT_EQ(expected, static_cast<int>(m_order.quads.size()));
}

TEST_P(ColumnOrders, RangesOfOneColourTouchNoColumnTwice) {
    // A sweep over a range reads and writes its columns and their neighbours.
    for (const auto& colour : m_order.columns) {
        std::set<std::int32_t> touched;
        std::size_t sum = 0;
        for (const Range& range : colour) {
            std::set<std::int32_t> own;
            for (std::int32_t v = range.begin; v < range.end; ++v) {
                own.insert(v);
                for (std::int32_t e = m_order.lower_begin[v]; e < m_order.lower_begin[v + 1]; ++e)
                    own.insert(m_order.lower_column[e]);
                for (std::int32_t u = m_order.upper_begin[v]; u < m_order.upper_begin[v + 1]; ++u)
                    own.insert(m_order.upper_column[u]);
            }
            sum += own.size();
            touched.insert(own.begin(), own.end());
        }
        EXPECT_EQ(sum, touched.size());
    }
    for (const auto& colour : m_order.quad_ranges) {
        std::set<std::int32_t> touched;
        std::size_t sum = 0;
        for (const Range& range : colour) {
            std::set<std::int32_t> own;
            for (std::int32_t q = range.begin; q < range.end; ++q)
                own.insert(m_order.quads[q].begin(), m_order.quads[q].end());
            sum += own.size();
            touched.insert(own.begin(), own.end());
        }
        EXPECT_EQ(sum, touched.size());
    }
}

TEST_P(ColumnOrders, LowerAndUpperAreTransposesAndHoldEveryPair) {
    std::set<std::pair<int, int>> pairs;
    for (const auto& quad : m_order.quads)
        for (const auto a : quad)
            for (const auto b : quad)
                if (a > b) pairs.insert({a, b});
    EXPECT_EQ(pairs.size(), m_order.lower_column.size());
    for (std::int32_t v = 0; v < m_order.column_count(); ++v)
        for (std::int32_t u = m_order.upper_begin[v]; u < m_order.upper_begin[v + 1]; ++u) {
            const std::int32_t row = m_order.upper_column[u];
            const std::int32_t entry = m_order.upper_entry[u];
            ASSERT_EQ(m_order.lower_column[entry], v);
            ASSERT_TRUE(m_order.lower_begin[row] <= entry && entry < m_order.lower_begin[row + 1]);
            ASSERT_EQ(pairs.count({row, v}), 1U);
        }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ColumnOrders,
                         testing::Values(geometry::Lattice{3, 3, 3}, geometry::Lattice{8, 8, 8},
                                         geometry::Lattice{24, 40, 24}));

}  // namespace
}  // namespace windfall::drying
