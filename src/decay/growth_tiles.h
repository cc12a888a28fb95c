#pragma once
// The texels of an atlas cut into tiles, so that work goes only where organisms are.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "decay/growth_stencil.h"

namespace windfall::decay {

/// Tiles of kWidth x kHeight texels over the texture, row by row; those at the right and lower edge may be
/// smaller.
class TileGrid {
  public:
    static constexpr int kWidth = 64, kHeight = 8;
    static constexpr int kTexels = kWidth * kHeight;

    explicit TileGrid(const SurfaceStencil& stencil);

    int side() const { return m_side; }
    std::size_t count() const { return static_cast<std::size_t>(m_across) * m_down; }
    std::size_t tile_of(std::size_t texel) const {
        return texel / m_side / kHeight * m_across + texel % m_side / kWidth;
    }

    /// Tiles side by side, which are gone through row by row: memory is then read in long stretches.
    struct Run {
        std::uint32_t first = 0, count = 0;
    };
    static constexpr std::uint32_t kLongestRun = 16;
    /// Rising tiles as runs.
    std::vector<Run> runs(const std::vector<std::uint32_t>& rising) const;

    /// Calls piece(tile, begin, end) for the texels that each row of a run has in each of its tiles.
    template <class Piece>
    void for_pieces(const Run& run, const Piece& piece) const {
        const int x0 = static_cast<int>(run.first % m_across) * kWidth;
        const int y0 = static_cast<int>(run.first / m_across) * kHeight;
        for (int y = y0; y < std::min(y0 + kHeight, m_side); ++y) {
            for (std::uint32_t k = 0; k < run.count; ++k) {
                const int x = x0 + static_cast<int>(k) * kWidth;
                const std::size_t begin = static_cast<std::size_t>(y) * m_side + x;
                piece(run.first + k, begin, begin + std::min(kWidth, m_side - x));
            }
        }
    }

    /// Tiles that hold a surface, in order.
    const std::vector<std::uint32_t>& covered() const { return m_covered; }
    /// The tiles that share a link or a corner with a tile, itself among them, in rising order.
    const std::vector<std::uint32_t>& around(std::size_t tile) const { return m_around[tile]; }
    /// The tile's seam texels: [first, second) of SurfaceStencil's seam_texels as listed in `seam_order`.
    std::uint32_t seam_begin(std::size_t tile) const { return m_seam_begin[tile]; }
    std::uint32_t seam_end(std::size_t tile) const { return m_seam_begin[tile + 1]; }
    /// Indices into SurfaceStencil's seam_texels, tile by tile.
    const std::vector<std::uint32_t>& seam_order() const { return m_seam_order; }

    /// The covered tiles that are flagged or lie around one that is, in rising order.
    std::vector<std::uint32_t> with_surroundings(const std::vector<std::uint8_t>& flags) const;

  private:
    int m_side, m_across, m_down;
    std::vector<std::uint32_t> m_covered;
    std::vector<std::vector<std::uint32_t>> m_around;
    std::vector<std::uint32_t> m_seam_begin, m_seam_order;
};

}  // namespace windfall::decay
