#include "decay/growth_diffusion.h"

#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace windfall::decay {

namespace {

/// Runs of tiles of one task.
constexpr std::size_t kRunsPerTask = 2;
constexpr double kStabilityMargin = 0.9;

/// What a stage reads, each from the first texel of a piece of a row on.
struct StageRow {
    const float *density, *east, *south, *south_east, *south_west, *inverse_area;
};

/// out = u + nu (out - u) + w div(conductance grad u). A function of its own: only so does the compiler know
/// that what it writes is nothing that it reads.
[[gnu::noinline]] void stage_row(const StageRow& row, std::ptrdiff_t side, std::ptrdiff_t count, float nu,
                                 float w, float* __restrict out) {
    const float* __restrict u = row.density, * __restrict inverse_area = row.inverse_area;
    const float* __restrict up = u - side, * __restrict down = u + side;
    const float* __restrict e = row.east, * __restrict s = row.south;
    const float* __restrict se = row.south_east, * __restrict sw = row.south_west;
    const float* __restrict n = s - side, * __restrict nw = se - side, * __restrict ne = sw - side;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const float here = u[i];
        const float flux = e[i] * (u[i + 1] - here) + e[i - 1] * (u[i - 1] - here) + s[i] * (down[i] - here) +
                           n[i] * (up[i] - here) + se[i] * (down[i + 1] - here) +
                           nw[i - 1] * (up[i - 1] - here) + sw[i] * (down[i - 1] - here) +
                           ne[i + 1] * (up[i + 1] - here);
        out[i] = here + nu * (out[i] - here) + w * inverse_area[i] * flux;
    }
}

}  // namespace

int stage_count(double stiffness, bool single) {
    // (s^2 + s) / 2 >= stiffness / margin
    const double wanted = 2 * stiffness / kStabilityMargin;
    if (single && wanted <= 2) return 1;
    const int stages = static_cast<int>(std::ceil((std::sqrt(1 + 4 * wanted) - 1) / 2));
    return std::max(2, stages + stages % 2);
}

SkinDiffusion::SkinDiffusion(const SurfaceStencil& stencil, const TileGrid& tiles)
    : m_stencil(stencil),
      m_tiles(tiles),
      // slots: inverse_area has 4, the organisms and the nutrient 7 and up
      m_mobility(stencil.side, 5),
      m_east(stencil.side, 0),
      m_south(stencil.side, 1),
      m_south_east(stencil.side, 2),
      m_south_west(stencil.side, 3),
      m_other(stencil.side, 6),
      m_seam(stencil.seam_weight.size(), 0),
      m_filled(tiles.count(), 0),
      m_largest_link_sum(tiles.count(), 0) {
    const std::vector<float> sums = link_sums(stencil);
    for (std::size_t texel = 0; texel < sums.size(); ++texel) {
        float& largest = m_largest_link_sum[tiles.tile_of(texel)];
        largest = std::max(largest, sums[texel]);
    }
}

template <class Visit>
void SkinDiffusion::for_seam_texels(const TileGrid::Run& run, const Visit& visit) const {
    const std::uint32_t end = m_tiles.seam_end(run.first + run.count - 1);
    for (std::uint32_t n = m_tiles.seam_begin(run.first); n < end; ++n) {
        const std::uint32_t seam = m_tiles.seam_order()[n];
        visit(m_stencil.seam_texels[seam], m_stencil.seam_begin[seam], m_stencil.seam_begin[seam + 1]);
    }
}

void SkinDiffusion::clear_all_but(const std::vector<std::uint32_t>& tiles) {
    std::vector<std::uint8_t> used(m_tiles.count(), 0);
    for (const std::uint32_t tile : tiles) used[tile] = 1;
    for (std::size_t tile = 0; tile < used.size(); ++tile) {
        if (m_filled[tile] != 0 && used[tile] == 0)
            m_tiles.for_pieces({static_cast<std::uint32_t>(tile), 1}, [&](std::uint32_t, std::size_t begin,
                                                                          std::size_t end) {
                for (TexelField* field : {&m_mobility, &m_east, &m_south, &m_south_east, &m_south_west})
                    std::fill(field->data() + begin, field->data() + end, 0.0F);
            });
        m_filled[tile] = used[tile];
    }
}

void SkinDiffusion::make_conductances(const std::vector<TileGrid::Run>& runs, const TexelField* gate) {
    const auto side = static_cast<std::ptrdiff_t>(m_stencil.side);
    const auto conductances = [&](TexelField& result, const TexelField& weight, std::ptrdiff_t gap,
                                  std::size_t begin, std::size_t end) {
        float* __restrict out = result.data();
        const float* __restrict w = weight.data();
        const float* __restrict d = m_mobility.data();
        const float* __restrict d_next = d + gap;
        if (gate == nullptr) {
            for (std::size_t i = begin; i < end; ++i) out[i] = w[i] * (d[i] + d_next[i]);
        } else {
            const float* __restrict g = gate->data();
            const float* __restrict g_next = g + gap;
            for (std::size_t i = begin; i < end; ++i) out[i] = w[i] * (d[i] + d_next[i]) * (g[i] * g_next[i]);
        }
    };
    parallel_blocks(runs.size(), kRunsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            m_tiles.for_pieces(runs[k], [&](std::uint32_t, std::size_t begin, std::size_t end) {
                conductances(m_east, m_stencil.east, 1, begin, end);
                conductances(m_south, m_stencil.south, side, begin, end);
                conductances(m_south_east, m_stencil.south_east, side + 1, begin, end);
                conductances(m_south_west, m_stencil.south_west, side - 1, begin, end);
            });
            for_seam_texels(runs[k], [&](std::uint32_t i, std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t link = begin; link < end; ++link) {
                    const std::uint32_t j = m_stencil.seam_neighbour[link];
                    const float open = gate == nullptr ? 1.0F : (*gate)[i] * (*gate)[j];
                    m_seam[link] = m_stencil.seam_weight[link] * (m_mobility[i] + m_mobility[j]) * open;
                }
            });
        }
    });
}

void SkinDiffusion::run_stages(TexelField& field, const std::vector<TileGrid::Run>& runs, const Links& links,
                               int stages) {
    const auto side = static_cast<std::ptrdiff_t>(m_stencil.side);
    TexelField* now = &field;
    TexelField* before = &m_other;
    for (int stage = 1; stage <= stages; ++stage) {
        // Y_j = mu Y_(j-1) + nu Y_(j-2) + w_j L Y_(j-1) with mu + nu = 1, written as differences, so that
        // rounding of mu and nu makes nothing out of nothing.
        const auto j = static_cast<float>(stage);
        const float nu = stage == 1 ? 0 : (1 - j) / j;
        const float w = links.factor * (stage == 1 ? 1 : (2 * j - 1) / j) * 2 /
                        static_cast<float>(stages * stages + stages);
        const float* y = now->data();
        float* result = before->data();
        parallel_blocks(runs.size(), kRunsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) {
                m_tiles.for_pieces(runs[k], [&](std::uint32_t, std::size_t begin, std::size_t end) {
                    stage_row({y + begin, links.east + begin, links.south + begin, links.south_east + begin,
                               links.south_west + begin, m_stencil.inverse_area.data() + begin},
                              side, static_cast<std::ptrdiff_t>(end - begin), nu, w, result + begin);
                });
                for_seam_texels(runs[k], [&](std::uint32_t i, std::uint32_t begin, std::uint32_t end) {
                    float flux = 0;
                    for (std::uint32_t link = begin; link < end; ++link)
                        flux += links.seam[link] * (y[m_stencil.seam_neighbour[link]] - y[i]);
                    result[i] += w * m_stencil.inverse_area[i] * flux;
                });
            }
        });
        std::swap(now, before);
    }
    if (now != &field) std::swap(field, m_other);
}

int SkinDiffusion::spread(TexelField& field, const std::vector<std::uint32_t>& tiles,
                          const std::vector<float>& largest_mobility, const TexelField* gate) {
    const auto runs = m_tiles.runs(tiles);
    make_conductances(runs, gate);
    double stiffness = 0;
    for (const std::uint32_t tile : tiles) {
        float mobility = 0;
        for (const std::uint32_t near : m_tiles.around(tile))
            mobility = std::max(mobility, largest_mobility[near]);
        stiffness = std::max(stiffness, 2.0 * mobility * m_largest_link_sum[tile]);
    }
    const int stages = stage_count(stiffness, false);
    run_stages(field, runs,
               {m_east.data(), m_south.data(), m_south_east.data(), m_south_west.data(), m_seam.data(), 1},
               stages);
    return stages;
}

int SkinDiffusion::spread_evenly(TexelField& field, double mobility_m2) {
    const float largest = *std::max_element(m_largest_link_sum.begin(), m_largest_link_sum.end());
    const int stages = stage_count(mobility_m2 * largest, true);
    run_stages(field, m_tiles.runs(m_tiles.covered()),
               {m_stencil.east.data(), m_stencil.south.data(), m_stencil.south_east.data(),
                m_stencil.south_west.data(), m_stencil.seam_weight.data(), static_cast<float>(mobility_m2)},
               stages);
    return stages;
}

}  // namespace windfall::decay
