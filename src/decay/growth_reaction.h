#pragma once
// What happens at one texel in one step: organisms eat, grow and age (Kider, Raja, Badler 2011, eqs. (2),
// (3), (7), (8)), by Patankar updates, which keep all densities positive and lose nothing at any step.
#include <cstddef>
#include <cstdint>
#include <span>

#include "decay/growth_settings.h"

namespace windfall::decay {

/// Most organisms on one skin: a soft rot and four fungi.
inline constexpr std::size_t kMostOrganisms = 5;

/// Rates of an organism over one step, by how moist the place is: between intact dry skin and the inside of
/// rot.
struct StepRates {
    float damping_skin = 0, damping_inside = 0;  ///< gamma = CM(T) CM(aw), 0..1
    float growth = 0;                            ///< mu dt
    float saturation = 0;  ///< kappa of (1 + kappa) N / (1 + kappa N): 1 Michaelis-Menten, 0 linear
    float inverse_crowding = 0;
    float ageing = 0;  ///< sigma3 dt
    float ageing_density = 0, ageing_nutrient = 0;
    float least_density = 0;  ///< thinner active organism is counted as inactive
};

/// Where the damping of an organism is between its two values: gamma at a texel of that moisture (0..1).
inline float damping_at(const StepRates& rates, float moisture) {
    return rates.damping_skin + (rates.damping_inside - rates.damping_skin) * moisture;
}

StepRates step_rates(const Organism& organism, const GrowthConditions& conditions, double step_h);

/// One organism's densities on a run of texels.
struct OrganismRun {
    const StepRates* rates = nullptr;
    float* active = nullptr;
    float* inactive = nullptr;
    bool alive = false;  ///< result: whether any of it is active afterwards
};

/// Takes a run of `count` (at most TileGrid::kWidth) texels through one step; the organisms share the
/// nutrient.
void react(std::span<OrganismRun> organisms, float* nutrient, const float* moisture, std::size_t count);

}  // namespace windfall::decay
