#include "decay/growth_settings.h"

#include <fmt/format.h>

#include "core/error.h"
#include "decay/growth_reaction.h"

namespace windfall::decay {

namespace {

void check_at_least(const std::string& what, double value, double least) {
    if (!(value >= least))
        throw InputError(fmt::format("{} must be at least {:g}, not {:g}", what, least, value));
}

void check_share(const std::string& what, double value) {
    if (!(value >= 0 && value <= 1))
        throw InputError(fmt::format("{} must be 0 to 1, not {:g}", what, value));
}

void check_organism(const Organism& organism) {
    const std::string& name = organism.species.name;
    check_at_least(fmt::format("the motility of {}", name), organism.motility_m2_h, 0);
    check_at_least(fmt::format("the growth rate of {}", name), organism.growth_per_h, 0);
    check_at_least(fmt::format("the ageing rate of {}", name), organism.ageing_per_h, 0);
    check_at_least(fmt::format("the ageing density of {}", name), organism.ageing_density, 0);
    check_at_least(fmt::format("the ageing nutrient of {}", name), organism.ageing_nutrient, 0);
    // A logistic colony freezes where its capacity is well below the density it grows to.
    check_at_least(fmt::format("the capacity of {}", name), organism.capacity, 0.1);
    check_at_least(fmt::format("the crowding density of {}", name), organism.crowding, 0.01);
}

}  // namespace

Organism soft_rot_organism(const Species& species) {
    Organism organism;
    organism.species = species;
    // At 22 C the bacteria are further from their best than most fungi are, and must still run ahead of them.
    organism.motility_m2_h = 2.4e-6;
    organism.growth_per_h = 0.2;
    organism.crowding = 0.3;
    return organism;
}

Organism fungus_organism(const Species& species) {
    Organism organism;
    organism.species = species;
    return organism;
}

void check(const std::vector<Organism>& organisms, const GrowthSettings& settings) {
    if (organisms.empty() || organisms.size() > kMostOrganisms)
        throw InputError(
            fmt::format("{} organisms on one fruit: give 1 to {}", organisms.size(), kMostOrganisms));
    std::size_t rots = 0;
    for (const Organism& organism : organisms) {
        check_organism(organism);
        rots += organism.species.kind == OrganismKind::SoftRot ? 1 : 0;
    }
    if (rots != 1)
        throw InputError(fmt::format(
            "{} soft rots on one fruit: give exactly one (fungi only live where soft rot has been)", rots));
    check_at_least("the motility of the nutrient", settings.nutrient_motility_m2_h, 0);
    check_at_least("the nutrient at the start", settings.nutrient_level, 0);
    check_share("the noise of the nutrient", settings.nutrient_noise);
    check_share("the noise of the motility", settings.motility_noise);
    check_share("the noise per step", settings.step_noise);
    check_at_least("the length of the nutrient's noise in m", settings.nutrient_noise_m, 1e-6);
    check_at_least("the length of the motility's noise in m", settings.motility_noise_m, 1e-6);
    check_at_least("the longest step in hours", settings.longest_step_h, 1e-4);
    check_at_least("the density at which the gate begins to open", settings.gate_closed, 0);
    check_at_least("the density at which sap begins to wet the skin", settings.sap_begins, 0);
    check_at_least("the density at which sap has wetted the skin", settings.sap_full,
                   settings.sap_begins + 1e-6);
    check_at_least("the density at which the gate is open", settings.gate_open, settings.gate_closed + 1e-6);
}

}  // namespace windfall::decay
