#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"

namespace windfall {
namespace {

TEST(Random, DependsOnTheWholeKey) {
    const auto base = random_uniform4(1, RandomPurpose::ImperfectionNoise, 2, 3);
    EXPECT_EQ(base, random_uniform4(1, RandomPurpose::ImperfectionNoise, 2, 3));
    EXPECT_NE(base, random_uniform4(2, RandomPurpose::ImperfectionNoise, 2, 3));
    EXPECT_NE(base, random_uniform4(1, RandomPurpose::ImperfectionModes, 2, 3));
    EXPECT_NE(base, random_uniform4(1, RandomPurpose::ImperfectionNoise, 3, 3));
    EXPECT_NE(base, random_uniform4(1, RandomPurpose::ImperfectionNoise, 2, 4));
    EXPECT_NE(base, random_uniform4(std::uint64_t{1} + (std::uint64_t{1} << 32U),
                                    RandomPurpose::ImperfectionNoise, 2, 3));
}

TEST(Random, MomentsAreThoseOfTheDistributions) {
    constexpr int kCount = 100000;
    double sum = 0;
    double sum_sq = 0;
    double normal = 0;
    double normal_sq = 0;
    for (int i = 0; i < kCount; ++i) {
        const double u = random_uniform4(7, RandomPurpose::PictureSample, static_cast<std::uint64_t>(i))[1];
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        sum += u;
        sum_sq += u * u;
        const double g = random_normal2(7, RandomPurpose::PictureSample, static_cast<std::uint64_t>(i))[1];
        normal += g;
        normal_sq += g * g;
    }
    // Four standard errors
    EXPECT_NEAR(sum / kCount, 0.5, 4 / std::sqrt(12.0 * kCount));
    EXPECT_NEAR(sum_sq / kCount, 1.0 / 3, 4 * 0.3 / std::sqrt(1.0 * kCount));
    EXPECT_NEAR(normal / kCount, 0, 4 / std::sqrt(1.0 * kCount));
    EXPECT_NEAR(normal_sq / kCount, 1, 4 * std::sqrt(2.0 / kCount));
}

TEST(Parallel, SumsAreTheSameBitsForAnyThreadCount) {
    const auto sum = [] {
        return parallel_sum(100001, 1000, [](std::size_t begin, std::size_t end) {
            double partial = 0;
            for (std::size_t i = begin; i < end; ++i) partial += std::sin(static_cast<double>(i)) * 1e10;
            return partial;
        });
    };
    double one = 0;
    {
        const ThreadLimit limit(1);
        one = sum();
    }
    const ThreadLimit limit(2);
    EXPECT_EQ(one, sum());
}

}  // namespace
}  // namespace windfall
