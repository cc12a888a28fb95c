#include "decay/organisms_of.h"

#include <fmt/format.h>

#include "core/error.h"

namespace windfall::decay {

std::vector<Organism> organisms_of(const DecayParameters& parameters) {
    const GrowthParameters& growth = parameters.growth;
    const auto of_kind = [](const std::string& name, OrganismKind kind, const char* key) {
        const Species& found = species_named(name);
        if (found.kind != kind)
            throw InputError(fmt::format(
                "{}: {} is {}", key, name,
                found.kind == OrganismKind::SoftRot ? "a soft rot, not a mold" : "a mold, not a soft rot"));
        return found;
    };
    std::vector<Organism> organisms{
        soft_rot_organism(of_kind(growth.soft_rot, OrganismKind::SoftRot, "growth.soft_rot"))};
    for (const std::string& name : fungus_names(growth))
        organisms.push_back(fungus_organism(of_kind(name, OrganismKind::Fungus, "growth.fungi")));
    // s of eq. (4) is a sum of which porosity is one part; temperature, humidity and water have curves of
    // their own here.
    const double porosity = 0.4 + parameters.fruit.porosity / 100;
    for (Organism& organism : organisms) {
        organism.form = growth.form == GrowthForm::Kawasaki ? MotilityForm::Kawasaki : MotilityForm::Logistic;
        organism.motility_m2_h *= porosity * growth.growth / 50;
        organism.growth_per_h *= growth.growth / 50;
        organism.ageing_per_h *= growth.growth / 50;
    }
    return organisms;
}

GrowthSettings growth_settings_of(const DecayParameters& parameters) {
    const GrowthParameters& growth = parameters.growth;
    GrowthSettings settings;
    settings.nutrient_level = growth.nutrient;
    settings.nutrient_noise = growth.nutrient_noise;
    settings.nutrient_noise_m = growth.nutrient_noise_m;
    settings.motility_noise = growth.edge_noise;
    settings.motility_noise_m = growth.edge_noise_m;
    settings.step_noise = growth.step_noise;
    return settings;
}

ColonySettings colony_settings_of(const DecayParameters& parameters) {
    ColonySettings settings;
    settings.propagation = parameters.growth.propagation;
    settings.reach_m = parameters.growth.reach_m;
    settings.seed_radius_m = parameters.start.radius_m;
    return settings;
}

}  // namespace windfall::decay
