#include "take/map_lookup.h"

#include <algorithm>

namespace windfall::take {
namespace {

constexpr float kTexelUnit = 1.0F / 65535;

// Four texels and their weights.
struct Footprint {
    std::array<std::size_t, 4> texels;
    std::array<float, 4> weights;

    Footprint(const FrameMap& map, float u, float v) {
        const auto across = place(u, map.width), down = place(1 - v, map.height);
        const auto row = [&](int y) {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
        };
        const auto column = [](int x) { return static_cast<std::size_t>(x); };
        texels = {row(down.first) + column(across.first), row(down.first) + column(across.second),
                  row(down.second) + column(across.first), row(down.second) + column(across.second)};
        const float x = across.part, y = down.part;
        weights = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    }

  private:
    struct Place {
        int first, second;
        float part;
    };
    // std::max with the constant first turns a NaN into 0.
    static Place place(float t, int count) {
        const float limited =
            std::min(std::max(0.0F, t * static_cast<float>(count) - 0.5F), static_cast<float>(count - 1));
        const int first = static_cast<int>(limited);
        return {first, std::min(first + 1, count - 1), limited - static_cast<float>(first)};
    }
};

}  // namespace

std::array<float, 4> map_values(const FrameMap& map, float u, float v) {
    const Footprint print(map, u, v);
    std::array<float, 4> sum{};
    const auto components = static_cast<std::size_t>(map.components);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint16_t* texel = &map.values[print.texels[k] * components];
        for (std::size_t c = 0; c < components; ++c)
            sum[c] += print.weights[k] * static_cast<float>(texel[c]);
    }
    for (float& value : sum) value *= kTexelUnit;
    return sum;
}

float map_value(const FrameMap& map, float u, float v) {
    const Footprint print(map, u, v);
    const auto components = static_cast<std::size_t>(map.components);
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
        sum += print.weights[k] * static_cast<float>(map.values[print.texels[k] * components]);
    return kTexelUnit * sum;
}

}  // namespace windfall::take
