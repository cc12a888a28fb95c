#pragma once
// The organisms and the settings of their growth that the parameters ask for.
#include <vector>

#include "decay/colonies.h"
#include "decay/growth_settings.h"
#include "decay/parameters.h"

namespace windfall::decay {

/// Soft rot first, then the fungi. Throws InputError for a species that is not known or of the other kind.
std::vector<Organism> organisms_of(const DecayParameters& parameters);

GrowthSettings growth_settings_of(const DecayParameters& parameters);
ColonySettings colony_settings_of(const DecayParameters& parameters);

}  // namespace windfall::decay
