#include "fracture/bundles.h"

#include <gtest/gtest.h>

#include <set>

#include "core/angles.h"

namespace windfall::fracture {
namespace {

constexpr int kAngles = 20000;

BundleTable table_of(float angular) {
    BundleTable table;
    table.reset(7, 0, {0.1F, angular, 0.2F, 0.1F, 2.0F}, TensionField{});
    return table;
}

/// Numbers of the bricks met once round, in order.
std::vector<std::size_t> bricks_around(BundleTable& table, float radius) {
    std::vector<std::size_t> met;
    for (int i = 0; i < kAngles; ++i) {
        const std::size_t index =
            table.index_at(radius, kTwoPi<float> * static_cast<float>(i) / static_cast<float>(kAngles));
        if (met.empty() || met.back() != index) met.push_back(index);
    }
    return met;
}

TEST(Bundles, FollowOneAnotherAroundTheBranch) {
    for (const float angular : {10.0F, 2.0F, 0.9F, 0.31F, 0.1F, 0.03F}) {
        BundleTable table = table_of(angular);
        std::set<std::size_t> all;
        for (float radius = 0.005F; radius < 1.4F; radius += 0.01F) {
            const std::vector<std::size_t> met = bricks_around(table, radius);
            int jumps = 0;  // from the last brick of the band to its first
            for (std::size_t i = 1; i < met.size(); ++i) jumps += met[i] == met[i - 1] + 1 ? 0 : 1;
            EXPECT_LE(jumps, 1) << "radius " << radius << ", bricks " << angular;
            all.insert(met.begin(), met.end());
        }
        EXPECT_EQ(all.size(), table.size()) << "bricks " << angular;
    }
}

TEST(Bundles, AreFoundAlikeFromAnywhere) {
    BundleTable around = table_of(0.3F), apart = table_of(0.3F);
    for (int i = 0; i < kAngles; ++i) {
        const float radius = 1.4F * static_cast<float>(i * 7919 % kAngles) / static_cast<float>(kAngles);
        const float angle = kTwoPi<float> * static_cast<float>(i) / static_cast<float>(kAngles);
        around.index_at(radius, 0);  // so that the search starts elsewhere
        ASSERT_EQ(around.at(radius, angle).name, apart.at(radius, angle).name);
    }
}

}  // namespace
}  // namespace windfall::fracture
