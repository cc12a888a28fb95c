#pragma once
// Diffusion of water in the flesh and its evaporation through the skin, in time.
#include <vector>

#include "drying/flesh_cells.h"

namespace windfall::drying {

/// What the skin over each quad lets through, in volumes of water a second. With the content m below the
/// skin, leaving * m / (m + solutes) - arriving evaporates, but never less than nothing: m / (m + solutes) is
/// the activity of water over a solution (Raoult's law).
struct SkinEvaporation {
    std::vector<double> leaving;   ///< at an activity of 1
    std::vector<double> arriving;  ///< for the vapour in the air
    double solutes = 0;            ///< content of dissolved matter, in volumes of as many molecules of water
};

/// Evaporation over one quad whose outermost cell holds `content`, and its derivative by that content;
/// `conductance` is from the cell's centre to the skin.
struct QuadEvaporation {
    double flux = 0;
    double slope = 0;
};
QuadEvaporation evaporation(double content, double conductance, double leaving, double arriving,
                            double solutes);

class FleshDiffusion {
  public:
    /// `diffusivity`: in lengths of the mesh squared a second. Keeps references to both.
    FleshDiffusion(const FleshCells& cells, const FleshConductances& conductances, double diffusivity);

    /// Where in a step the first of the two evaporations is taken, as a fraction; the other is at its end.
    static constexpr double kFirstStage = 0.29289321881345254;  // 1 - 1 / sqrt(2)

    /// Moves `contents` on by `dt` seconds by the two-stage, stiffly accurate SDIRK method of second order
    /// (Alexander 1977). Returns the volume of water that evaporated: what the cells have lost, to rounding,
    /// however far the linear solver went.
    double step(std::vector<double>& contents, double dt, const SkinEvaporation& first,
                const SkinEvaporation& last) const;

  private:
    struct Columns;
    /// Contents with contents = from + tau * (what flows in), from a start in `contents`. Returns what
    /// evaporates a second.
    double stage(const std::vector<double>& from, double tau, const SkinEvaporation& skin,
                 std::vector<double>& contents) const;
    void apply(const std::vector<double>& x, double tau, const std::vector<double>& leak,
               std::vector<double>& y) const;
    void solve(const std::vector<double>& right, double tau, const std::vector<double>& leak,
               std::vector<double>& x) const;

    const FleshCells& m_cells;
    const FleshConductances& m_conductances;
    double m_diffusivity;
};

}  // namespace windfall::drying
