#include "geometry/cube_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace windfall::geometry {

namespace {

constexpr int kCharts = 6, kColumns = 3;
constexpr double kQuarter_rad = std::numbers::pi / 4;

/// The two whole coordinates that a point lies between, held within [low, low + count), and the share of the
/// second one.
struct Between {
    int first = 0, second = 0;
    double share = 0;
};

Between between(double x, int low, int count) {
    const double inside = std::clamp(x - 0.5, static_cast<double>(low), static_cast<double>(low + count - 1));
    const int first = std::min(static_cast<int>(inside), low + count - 2);
    return {first, first + 1, inside - first};
}

}  // namespace

CubeAtlas::CubeAtlas(int side) : m_side(side) {
    if (side < kSmallest || side > kLargest || side % 2 != 0)
        throw InputError(
            fmt::format("a texture of {0} x {0} texels cannot be: give an even side from {1} to {2}", side,
                        kSmallest, kLargest));
    m_width = side / kColumns - 2 * kGutter;
    m_height = side / 2 - 2 * kGutter;
    m_chart.assign(texel_count(), -1);
    for (const Run& run : runs())
        std::fill(m_chart.begin() + static_cast<std::ptrdiff_t>(run.begin),
                  m_chart.begin() + static_cast<std::ptrdiff_t>(run.end),
                  static_cast<std::int16_t>(run.chart));
    make_bleeds();
}

std::array<int, 2> CubeAtlas::chart_origin(int chart) const {
    const int column = chart % kColumns;
    const int row_from_top = 1 - chart / kColumns;
    return {column * (m_side / kColumns) + kGutter, row_from_top * (m_side / 2) + kGutter};
}

Vec2 CubeAtlas::uv(int chart, double s, double t) const {
    const TexelPoint p = texel_point({chart, s, t});
    return {p.x / m_side, 1 - p.y / m_side};
}

Vec3 CubeAtlas::direction(int chart, double s, double t) {
    const auto [a, b] = side_axes(chart);
    Vec3 d;
    d[chart / 2] = chart % 2 == 1 ? 1 : -1;
    d[a] = std::tan(kQuarter_rad * (2 * s - 1));
    d[b] = std::tan(kQuarter_rad * (2 * t - 1));
    return d.normalized();
}

CubeAtlas::ChartPoint CubeAtlas::chart_point(const Vec3& direction) {
    int axis = 0;
    const double largest = direction.cwiseAbs().maxCoeff(&axis);
    const int chart = 2 * axis + (direction[axis] > 0 ? 1 : 0);
    const auto [a, b] = side_axes(chart);
    const auto along = [&](int i) { return 0.5 + 0.5 * std::atan(direction[i] / largest) / kQuarter_rad; };
    return {chart, along(a), along(b)};
}

CubeAtlas::TexelPoint CubeAtlas::texel_point(const ChartPoint& point) const {
    const auto [x, y] = chart_origin(point.chart);
    return {point.chart, x + point.s * m_width, y + (1 - point.t) * m_height};
}

std::size_t CubeAtlas::texel_at(const Vec3& direction) const {
    const TexelPoint p = locate(direction);
    const auto [x0, y0] = chart_origin(p.chart);
    const int x = std::clamp(static_cast<int>(p.x), x0, x0 + m_width - 1);
    const int y = std::clamp(static_cast<int>(p.y), y0, y0 + m_height - 1);
    return static_cast<std::size_t>(y) * m_side + x;
}

Vec3 CubeAtlas::texel_direction(std::size_t texel) const {
    const int chart = chart_of(texel);
    const auto [x0, y0] = chart_origin(chart);
    const std::size_t column = texel % m_side, row = texel / m_side;
    const double x = static_cast<double>(column) + 0.5 - x0;
    const double y = static_cast<double>(row) + 0.5 - y0;
    return direction(chart, x / m_width, 1 - y / m_height);
}

std::vector<CubeAtlas::Run> CubeAtlas::runs() const {
    std::vector<Run> result;
    result.reserve(static_cast<std::size_t>(kCharts) * m_height);
    for (int chart = 0; chart < kCharts; ++chart) {
        const auto [x0, y0] = chart_origin(chart);
        for (int y = y0; y < y0 + m_height; ++y) {
            const std::size_t begin = static_cast<std::size_t>(y) * m_side + x0;
            result.push_back({begin, begin + m_width, chart});
        }
    }
    return result;
}

void CubeAtlas::make_bleeds() {
    const int cell_width = m_side / kColumns;
    const int cell_height = m_side / 2;
    for (std::size_t texel = 0; texel < texel_count(); ++texel) {
        if (covered(texel)) continue;
        const int x = static_cast<int>(texel % m_side);
        const int y = static_cast<int>(texel / m_side);
        // The columns that three cells leave over at the right go with the last cell.
        const int chart = std::min(x / cell_width, kColumns - 1) + (y < cell_height ? kColumns : 0);
        const auto [x0, y0] = chart_origin(chart);
        const TexelPoint p =
            locate(direction(chart, (x + 0.5 - x0) / m_width, 1 - (y + 0.5 - y0) / m_height));
        const auto [px0, py0] = chart_origin(p.chart);
        const Between h = between(p.x, px0, m_width);
        const Between v = between(p.y, py0, m_height);
        const auto at = [&](int i, int j) {
            return static_cast<std::uint32_t>(static_cast<std::size_t>(j) * m_side + i);
        };
        m_bleeds.push_back(
            {static_cast<std::uint32_t>(texel),
             {at(h.first, v.first), at(h.second, v.first), at(h.first, v.second), at(h.second, v.second)},
             {static_cast<float>((1 - h.share) * (1 - v.share)), static_cast<float>(h.share * (1 - v.share)),
              static_cast<float>((1 - h.share) * v.share), static_cast<float>(h.share * v.share)}});
    }
}

void CubeAtlas::bleed(std::span<float> map, int channels) const {
    const auto step = static_cast<std::size_t>(channels);
    if (map.size() != texel_count() * step)
        throw InputError(
            fmt::format("a map of {} values does not fit a texture of {} x {} texels and {} channels",
                        map.size(), m_side, m_side, channels));
    for (const Bleed& bleed : m_bleeds) {
        for (std::size_t c = 0; c < step; ++c) {
            float sum = 0;
            for (int k = 0; k < 4; ++k) sum += bleed.weight[k] * map[bleed.from[k] * step + c];
            map[bleed.texel * step + c] = sum;
        }
    }
}

float CubeAtlas::sample(std::span<const float> map, const Vec3& direction) const {
    const TexelPoint p = locate(direction);
    const auto [x0, y0] = chart_origin(p.chart);
    const Between h = between(p.x, x0 - kGutter, m_width + 2 * kGutter);
    const Between v = between(p.y, y0 - kGutter, m_height + 2 * kGutter);
    const auto at = [&](int i, int j) {
        return static_cast<double>(map[static_cast<std::size_t>(j) * m_side + i]);
    };
    const double upper = at(h.first, v.first) + h.share * (at(h.second, v.first) - at(h.first, v.first));
    const double lower = at(h.first, v.second) + h.share * (at(h.second, v.second) - at(h.first, v.second));
    return static_cast<float>(upper + v.share * (lower - upper));
}

std::vector<std::array<Vec2, 4>> CubeAtlas::corner_uvs(const BrickSurface& brick) const {
    std::vector<std::array<Vec2, 4>> uvs;
    uvs.reserve(brick.quads.size());
    for (int chart = 0; chart < kCharts; ++chart) {
        const auto [a, b] = side_axes(chart);
        const double columns = brick.cells[a], rows = brick.cells[b];
        for (int j = 0; j < brick.cells[b]; ++j) {
            for (int i = 0; i < brick.cells[a]; ++i)
                uvs.push_back({uv(chart, i / columns, j / rows), uv(chart, (i + 1) / columns, j / rows),
                               uv(chart, (i + 1) / columns, (j + 1) / rows),
                               uv(chart, i / columns, (j + 1) / rows)});
        }
    }
    return uvs;
}

}  // namespace windfall::geometry
