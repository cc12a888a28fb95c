#pragma once
// Diffusion on the skin over one step, by stabilised explicit stages: RKL1 of C. D. Meyer, D. S. Balsara, T.
// D. Aslam, A stabilized Runge-Kutta-Legendre method for explicit super-time-stepping, J. Comput. Phys. 257,
// 2014. s stages cover (s^2 + s) / 2 explicit steps. Mobilities are held at their values at the start of the
// step.
#include <cstdint>
#include <span>
#include <vector>

#include "decay/growth_field.h"
#include "decay/growth_stencil.h"
#include "decay/growth_tiles.h"

namespace windfall::decay {

/// Stages that keep a step stable when `stiffness` is the step times the largest sum of conductances over
/// area; even for organisms (the result then lies where the start did), 1 for mild cases where `single`
/// allows it.
int stage_count(double stiffness, bool single);

/// The operator with its scratch fields. Everything outside the tiles that are worked on stays untouched, and
/// no flux crosses their outer rim, since the mobility is zero in the outermost of them.
class SkinDiffusion {
  public:
    SkinDiffusion(const SurfaceStencil& stencil, const TileGrid& tiles);

    /// Mobility in m2 (times the step), a half of it at each end of a link; to be filled for the tiles of a
    /// step.
    TexelField& half_mobility() { return m_mobility; }
    /// Sets mobility and conductances to zero in the tiles that an earlier step used and `tiles` does not
    /// name.
    void clear_all_but(const std::vector<std::uint32_t>& tiles);

    /// Spreads `field` over `tiles` with half_mobility; `gate`, where given, multiplies each link by its
    /// values at both ends. `largest_mobility`: per tile of the grid, its largest half mobility. Returns the
    /// stages taken.
    int spread(TexelField& field, const std::vector<std::uint32_t>& tiles,
               const std::vector<float>& largest_mobility, const TexelField* gate);

    /// Spreads `field` over the whole skin with one mobility in m2 (times the step). Returns the stages
    /// taken.
    int spread_evenly(TexelField& field, double mobility_m2);

    /// Per tile: its largest sum of link weights over area, 1/m2.
    const std::vector<float>& largest_link_sum() const { return m_largest_link_sum; }

  private:
    /// What flows through the links: conductances of the four forward links of each texel, and of the seam's.
    struct Links {
        const float *east, *south, *south_east, *south_west;
        const float* seam;
        float factor;
    };
    /// Calls visit(texel, begin, end) for the texels of a run that have seam links [begin, end).
    template <class Visit>
    void for_seam_texels(const TileGrid::Run& run, const Visit& visit) const;
    void make_conductances(const std::vector<TileGrid::Run>& runs, const TexelField* gate);
    void run_stages(TexelField& field, const std::vector<TileGrid::Run>& runs, const Links& links,
                    int stages);

    const SurfaceStencil& m_stencil;
    const TileGrid& m_tiles;
    TexelField m_mobility, m_east, m_south, m_south_east, m_south_west, m_other;
    std::vector<float> m_seam;
    std::vector<std::uint8_t> m_filled;
    std::vector<float> m_largest_link_sum;
};

}  // namespace windfall::decay
