#pragma once
// Loops over long vectors whose results do not depend on the number of threads.
#include <array>
#include <cstddef>
#include <vector>

#include "core/parallel.h"

namespace windfall::drying {

constexpr std::size_t kVectorBlock = std::size_t{1} << 14U;

/// N sums over [0, count): body(i, lane, sums) adds term i to sums[n][lane]. Eight running sums of each,
/// which vectorises without changing with the optimiser's mood.
template <std::size_t N, class Body>
std::array<double, N> lane_sums(std::size_t count, std::size_t block, const Body& body) {
    constexpr std::size_t kLanes = 8;
    std::vector<std::array<double, N>> partial((count + block - 1) / block);
    parallel_blocks(count, block, [&](std::size_t begin, std::size_t end) {
        double sums[N][kLanes] = {};
        std::size_t i = begin;
        for (; i + kLanes <= end; i += kLanes)
            for (std::size_t lane = 0; lane < kLanes; ++lane) body(i + lane, lane, sums);
        for (; i < end; ++i) body(i, 0, sums);
        for (std::size_t n = 0; n < N; ++n)
            partial[begin / block][n] = ((sums[n][0] + sums[n][1]) + (sums[n][2] + sums[n][3])) +
                                        ((sums[n][4] + sums[n][5]) + (sums[n][6] + sums[n][7]));
    });
    std::array<double, N> result{};
    for (const auto& sums : partial)
        for (std::size_t n = 0; n < N; ++n) result[n] += sums[n];
    return result;
}

/// Inner product, summed in double precision.
inline double dot(const float* a, const float* b, std::size_t size) {
    return lane_sums<1>(size, kVectorBlock, [=](std::size_t i, std::size_t lane, auto& sums) {
        sums[0][lane] += static_cast<double>(a[i]) * b[i];
    })[0];
}

/// Inner products of a and b with c, in one pass.
inline std::array<double, 2> dots(const float* a, const float* b, const float* c, std::size_t size) {
    return lane_sums<2>(size, kVectorBlock, [=](std::size_t i, std::size_t lane, auto& sums) {
        const double factor = c[i];
        sums[0][lane] += a[i] * factor;
        sums[1][lane] += b[i] * factor;
    });
}

/// r -= alpha q; returns r r.
inline double subtract(float alpha, const float* q, float* r, std::size_t size) {
    return lane_sums<1>(size, kVectorBlock, [=](std::size_t i, std::size_t lane, auto& sums) {
        r[i] -= alpha * q[i];
        sums[0][lane] += static_cast<double>(r[i]) * r[i];
    })[0];
}

/// Calls body(i) for i in [0, size), in any order, from several threads.
template <class Body>
void for_elements(std::size_t size, const Body& body) {
    parallel_blocks(size, kVectorBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

}  // namespace windfall::drying
