#include "decay/growth_reaction.h"

#include <array>
#include <bit>

#include "decay/growth_tiles.h"

namespace windfall::decay {

StepRates step_rates(const Organism& organism, const GrowthConditions& conditions, double step_h) {
    const Species& species = organism.species;
    const double warmth = cardinal_growth(species.temperature_c, conditions.temperature_c);
    const auto damping = [&](double water_activity) {
        return static_cast<float>(warmth * cardinal_growth(species.water_activity, water_activity));
    };
    StepRates rates;
    rates.damping_skin = damping(conditions.water_activity_skin);
    rates.damping_inside = damping(conditions.water_activity_inside);
    rates.growth = static_cast<float>(organism.growth_per_h * step_h);
    rates.saturation = organism.law == GrowthLaw::MichaelisMenten ? 1 : 0;
    rates.inverse_crowding = static_cast<float>(1 / organism.crowding);
    rates.ageing = static_cast<float>(organism.ageing_per_h * step_h);
    rates.ageing_density = static_cast<float>(organism.ageing_density);
    rates.ageing_nutrient = static_cast<float>(organism.ageing_nutrient);
    // A front of constant diffusivity is pulled by its thin foot: it must keep more of it (E. Brunet, B.
    // Derrida, Phys. Rev. E 56, 1997: a cut at e slows it by pi^2 / (2 ln^2 e)).
    rates.least_density = organism.form == MotilityForm::Linear ? 1e-30F : 1e-9F;
    return rates;
}

void react(std::span<OrganismRun> organisms, float* __restrict nutrient, const float* __restrict moisture,
           std::size_t count) {
    using Run = std::array<float, TileGrid::kWidth>;
    Run density{}, eaten{};
    std::array<Run, kMostOrganisms> gain;
    for (std::size_t x = 0; x < count; ++x) density[x] = nutrient[x];
    for (const OrganismRun& run : organisms)
        for (std::size_t x = 0; x < count; ++x) density[x] += run.active[x];

    for (std::size_t o = 0; o < organisms.size(); ++o) {
        const StepRates r = *organisms[o].rates;
        const float *u = organisms[o].active, *v = organisms[o].inactive;
        float* m = gain[o].data();
        for (std::size_t x = 0; x < count; ++x) {
            const float room = 1 - (u[x] + v[x]) * r.inverse_crowding;
            const float rate = damping_at(r, moisture[x]) * r.growth * (1 + r.saturation) /
                               (1 + r.saturation * nutrient[x]) * (room > 0 ? room : 0);
            // With m = (exp(k C) - 1) / C, C = u + n, the Patankar update u (1 + m n'), n' = n / (1 + m u) is
            // the exact solution of u' = k u n, n' = -k u n over the step; the bracket is that series.
            const float grown = rate * density[x];
            m[x] = rate * (1 + grown * (0.5F + grown * (1.0F / 6)));
            eaten[x] += m[x] * u[x];
        }
    }
    for (std::size_t x = 0; x < count; ++x) nutrient[x] /= 1 + eaten[x];

    for (std::size_t o = 0; o < organisms.size(); ++o) {
        const StepRates r = *organisms[o].rates;
        float* __restrict u = organisms[o].active, * __restrict v = organisms[o].inactive;
        const float* __restrict m = gain[o].data();
        std::uint32_t any = 0;  // bits instead of a largest value: those are added up in any order
        for (std::size_t x = 0; x < count; ++x) {
            const float grown = u[x] + m[x] * u[x] * nutrient[x];
            const float slowness = (1 + r.ageing_density * grown) * (1 + r.ageing_nutrient * nutrient[x]);
            const float young = grown * slowness / (slowness + damping_at(r, moisture[x]) * r.ageing);
            const float kept = young > r.least_density ? young : 0;
            v[x] += grown - kept;
            u[x] = kept;
            any |= std::bit_cast<std::uint32_t>(kept);
        }
        organisms[o].alive = organisms[o].alive || any != 0;
    }
}

}  // namespace windfall::decay
