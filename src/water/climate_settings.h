#pragma once
// The climate as recipes of every process name it: the table [climate].
#include <vector>

#include "core/parameter_group.h"
#include "water/climate.h"

namespace windfall::water {

enum class ClimateName { Temperate, Tropical, ColdDesert, HotDesert, Fridge, Constant, Table };

struct ClimateParameters {
    ClimateName name = ClimateName::Temperate;
    double temperature_c = 22, humidity = 0.5;              ///< constant
    std::vector<double> hours, temperatures_c, humidities;  ///< table: a day and a night
};

/// The air that the parameters ask for. Throws InputError, naming the keys, for a table whose columns differ
/// in length or that Climate does not take.
Climate climate_of(const ClimateParameters& parameters);

/// Declares the keys of [climate], bound to a member of a process's parameters.
template <class Parameters>
void add_climate(ParameterTable<Parameters>& table, ClimateParameters Parameters::*member) {
    using P = ClimateParameters;
    ParameterGroup t(table, "climate", member);
    t.add_choice(
        "name", &P::name,
        {"temperate", "tropical", "cold-desert", "hot-desert", "fridge", "constant", "table"},
        "the air: a named climate, constant as the next two keys say, or the table of the last three");
    t.add("temperature_c", "C", &P::temperature_c, "of the air, where it is constant",
          {.minimum = kColdestAir_c, .maximum = kHottestAir_c});
    t.add("humidity", "1", &P::humidity, "relative humidity of the air, where it is constant",
          {.minimum = 0, .maximum = 1});
    t.add("hours", "h", &P::hours,
          "of the day, rising from 0 to below 24; linear between, every day the same",
          {.minimum = 0, .below = 24});
    t.add("temperatures_c", "C", &P::temperatures_c, "of the air at those hours",
          {.minimum = kColdestAir_c, .maximum = kHottestAir_c});
    t.add("humidities", "1", &P::humidities, "relative humidities at those hours",
          {.minimum = 0, .maximum = 1});
}

}  // namespace windfall::water
