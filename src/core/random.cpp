#include "core/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace windfall {

std::array<double, 4> random_uniform4(std::uint64_t seed, RandomPurpose purpose, std::uint64_t index,
                                      std::uint32_t sub_index) {
    const r123::Philox4x32::ctr_type counter = {{static_cast<std::uint32_t>(index),
                                                 static_cast<std::uint32_t>(index >> 32U), sub_index,
                                                 static_cast<std::uint32_t>(purpose)}};
    const r123::Philox4x32::key_type key = {
        {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
    const auto bits = r123::Philox4x32()(counter, key);
    std::array<double, 4> result{};
    for (std::size_t i = 0; i < 4; ++i) result[i] = bits.v[i] * 0x1p-32;
    return result;
}

std::array<double, 2> random_normal2(std::uint64_t seed, RandomPurpose purpose, std::uint64_t index,
                                     std::uint32_t sub_index) {
    const auto u = random_uniform4(seed, purpose, index, sub_index);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - u[0]));  // 1 - u is in (0, 1]
    const double angle = 2.0 * std::numbers::pi * u[1];
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace windfall
