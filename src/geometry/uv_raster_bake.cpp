#include "geometry/uv_raster_bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"

namespace windfall::geometry {

namespace {

constexpr std::size_t kTapsPerBlock = 16384;

}  // namespace

AtlasBake::AtlasBake(const UvRaster& raster, const SphereMap& map, const CubeAtlas& atlas)
    : m_atlas_side(atlas.side()), m_texels(raster.texel_count()) {
    for (std::size_t texel = 0; texel < m_texels; ++texel)
        if (raster.covered(texel)) m_taps.push_back({static_cast<std::uint32_t>(texel), 0, 0, 0});
    parallel_blocks(m_taps.size(), kTapsPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Tap& tap = m_taps[i];
            const auto p = atlas.locate(map.direction(raster.place(tap.texel)));
            const auto [left, top] = atlas.chart_origin(p.chart);
            // The chart's own gutter carries its values on, so that all four neighbours are in the chart's
            // cell.
            const int x = std::clamp(static_cast<int>(p.x - 0.5), left - CubeAtlas::kGutter,
                                     left + atlas.chart_width() + CubeAtlas::kGutter - 2);
            const int y = std::clamp(static_cast<int>(p.y - 0.5), top - CubeAtlas::kGutter,
                                     top + atlas.chart_height() + CubeAtlas::kGutter - 2);
            tap.first = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(m_atlas_side) +
                        static_cast<std::uint32_t>(x);
            tap.right = static_cast<float>(p.x - 0.5 - x);
            tap.down = static_cast<float>(p.y - 0.5 - y);
        }
    });
}

void AtlasBake::bake(std::span<const float> atlas_map, std::span<float> result, int channels) const {
    const auto step = static_cast<std::size_t>(channels);
    const auto side = static_cast<std::size_t>(m_atlas_side);
    if (atlas_map.size() != side * side * step || result.size() != m_texels * step)
        throw InputError(fmt::format("maps of {} and {} values do not fit {} and {} texels of {} channels",
                                     atlas_map.size(), result.size(), side * side, m_texels, channels));
    parallel_blocks(m_taps.size(), kTapsPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Tap& tap = m_taps[i];
            const float* upper = atlas_map.data() + tap.first * step;
            const float* lower = upper + side * step;
            for (std::size_t c = 0; c < step; ++c) {
                const float above = upper[c] + tap.right * (upper[step + c] - upper[c]);
                const float below = lower[c] + tap.right * (lower[step + c] - lower[c]);
                result[tap.texel * step + c] = above + tap.down * (below - above);
            }
        }
    });
}

}  // namespace windfall::geometry
