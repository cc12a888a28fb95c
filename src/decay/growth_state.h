#pragma once
// The inside of Growth: its fields and one step.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decay/growth.h"
#include "decay/growth_diffusion.h"
#include "decay/growth_field.h"
#include "decay/growth_reaction.h"
#include "decay/growth_stencil.h"
#include "decay/growth_tiles.h"

namespace windfall::decay {

/// Thinner spots are not planted: their edge would only be rounding.
inline constexpr double kThinnestPlanted = 1e-6;
/// Texels of one task where all are passed over.
inline constexpr std::size_t kTexelsPerTask = 8192;

/// One organism on the skin.
struct Life {
    Organism organism;
    TexelField active, inactive;
    TexelField motility_factor;           ///< frozen noise, about 1
    std::vector<std::uint8_t> alive;      ///< per tile: whether any of it is active there
    std::vector<float> largest_mobility;  ///< per tile, of the running step
};

struct Growth::State {
    State(const geometry::CubeAtlas& atlas, std::span<const geometry::Vec3> texel_positions_m,
          const std::vector<Organism>& chosen, const GrowthSettings& chosen_settings,
          std::uint64_t chosen_seed, const GrowthFields& fields);
    ~State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    double longest_step_h(const GrowthConditions& conditions) const;
    void step(double step_h, const GrowthConditions& conditions);
    /// Opens the gate, and moistens the skin, where soft rot has become dense.
    void open_gate();
    double active_share() const;
    std::vector<std::byte> save() const;
    void restore(std::span<const std::byte> bytes);

    GrowthSettings settings;
    std::uint64_t seed;
    std::vector<geometry::Vec3> positions;
    SurfaceStencil stencil;
    TileGrid tiles;
    SkinDiffusion diffusion;
    std::vector<Life> organisms;
    std::size_t soft_rot = 0;  ///< its place in `organisms`
    TexelField nutrient, gate;
    TexelField moisture;  ///< wetness, and what sap has added since: 0 dry skin .. 1 as inside rot
    double time_h = 0;
    double nutrient_due_h = 0;  ///< time for which the nutrient has not yet been spread
    double mean_nutrient = 1;   ///< at the start; sets the speed of fronts
    std::uint64_t steps = 0, passes = 0;

  private:
    void set_fields(const geometry::CubeAtlas& atlas, const GrowthFields& fields);
    std::vector<std::uint32_t> working_tiles(const Life& life) const;
    void set_mobility(Life& life, std::size_t o, const StepRates& rates, double step_h,
                      const std::vector<std::uint32_t>& working);
    void react_all(std::span<const StepRates> rates, const std::vector<std::vector<std::uint32_t>>& working);
    std::vector<TexelField*> saved_fields();
};

}  // namespace windfall::decay
