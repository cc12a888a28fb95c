#include "decay/growth_tiles.h"

namespace windfall::decay {

TileGrid::TileGrid(const SurfaceStencil& stencil)
    : m_side(stencil.side),
      m_across((stencil.side + kWidth - 1) / kWidth),
      m_down((stencil.side + kHeight - 1) / kHeight) {
    std::vector<std::uint8_t> holds_surface(count(), 0);
    for (std::size_t texel = 0; texel < stencil.area_m2.size(); ++texel)
        if (stencil.area_m2[texel] > 0) holds_surface[tile_of(texel)] = 1;
    for (std::size_t tile = 0; tile < count(); ++tile)
        if (holds_surface[tile] != 0) m_covered.push_back(static_cast<std::uint32_t>(tile));

    m_around.resize(count());
    for (int ty = 0; ty < m_down; ++ty) {
        for (int tx = 0; tx < m_across; ++tx) {
            auto& around = m_around[static_cast<std::size_t>(ty) * m_across + tx];
            for (int y = std::max(ty - 1, 0); y <= std::min(ty + 1, m_down - 1); ++y)
                for (int x = std::max(tx - 1, 0); x <= std::min(tx + 1, m_across - 1); ++x)
                    around.push_back(static_cast<std::uint32_t>(y * m_across + x));
        }
    }
    std::vector<std::vector<std::uint32_t>> seam_texels(count());
    for (std::size_t k = 0; k < stencil.seam_texels.size(); ++k) {
        const std::size_t tile = tile_of(stencil.seam_texels[k]);
        seam_texels[tile].push_back(static_cast<std::uint32_t>(k));
        for (std::uint32_t link = stencil.seam_begin[k]; link < stencil.seam_begin[k + 1]; ++link)
            m_around[tile].push_back(static_cast<std::uint32_t>(tile_of(stencil.seam_neighbour[link])));
    }
    for (auto& around : m_around) {
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
    }
    m_seam_begin.push_back(0);
    for (const auto& texels : seam_texels) {
        m_seam_order.insert(m_seam_order.end(), texels.begin(), texels.end());
        m_seam_begin.push_back(static_cast<std::uint32_t>(m_seam_order.size()));
    }
}

std::vector<TileGrid::Run> TileGrid::runs(const std::vector<std::uint32_t>& rising) const {
    std::vector<Run> result;
    for (const std::uint32_t tile : rising) {
        const bool next_to_last = !result.empty() && tile == result.back().first + result.back().count;
        if (next_to_last && tile % m_across != 0 && result.back().count < kLongestRun)
            ++result.back().count;
        else
            result.push_back({tile, 1});
    }
    return result;
}

std::vector<std::uint32_t> TileGrid::with_surroundings(const std::vector<std::uint8_t>& flags) const {
    std::vector<std::uint32_t> tiles;
    for (const std::uint32_t tile : m_covered) {
        const auto& near = m_around[tile];
        if (std::any_of(near.begin(), near.end(), [&](std::uint32_t t) { return flags[t] != 0; }))
            tiles.push_back(tile);
    }
    return tiles;
}

}  // namespace windfall::decay
