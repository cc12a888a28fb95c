#include "drying/moisture_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/parameter_group.h"
#include "drying/parameters.h"

namespace windfall::drying {

namespace {

constexpr std::size_t kNumbersPerShade = 5;

double length_of(const std::vector<double>& direction) {
    double sum = 0;
    for (const double x : direction) sum += x * x;
    return std::sqrt(sum);
}

}  // namespace

double MoistureParameters::solids_fraction() const {
    constexpr double kWater_kg_m3 = 1000;
    const double solids = (1 - water) / solids_kg_m3;
    return solids / (solids + water / kWater_kg_m3);
}

std::vector<Shade> shades_of(const MoistureParameters& parameters) {
    std::vector<Shade> result;
    const std::vector<double>& all = parameters.shades;
    for (std::size_t i = 0; i + kNumbersPerShade <= all.size(); i += kNumbersPerShade)
        result.push_back({{all[i], all[i + 1], all[i + 2]}, all[i + 3], all[i + 4]});
    return result;
}

void add_moisture(ParameterTable<DryingParameters>& table) {
    using P = MoistureParameters;
    water::add_climate(table, &DryingParameters::climate);
    ParameterGroup t(table, "moisture", &DryingParameters::moisture);
    t.add(
        "hours", "h", &P::hours,
        "how long the fruit dries in the air of [climate]; the flesh then shrinks where its water has left, "
        "by at most drying.shrinkage. 0: all flesh shrinks alike, as given",
        {.minimum = 0, .maximum = 100000});
    t.add("start_hour", "h", &P::start_hour, "hour of the day at which the drying begins",
          {.minimum = 0, .below = 24});
    t.add("diffusivity_m2_s", "m2/s", &P::diffusivity_m2_s,
          "of water in the flesh: 1e-10 to 1e-9 in fruit; from 1e-5 on all flesh dries alike",
          {.maximum = 1e-3, .above = 0});
    t.add("water", "1", &P::water, "share of the fresh flesh's mass that is water", {.above = 0, .below = 1});
    t.add("solids_kg_m3", "kg/m3", &P::solids_kg_m3, "density of what is not water; sugars 1550",
          {.minimum = 500, .maximum = 5000});
    t.add("transpiration_ug_s_m2_pa", "ug/(s m2 Pa)", &P::transpiration_ug_s_m2_pa,
          "K: water that leaves through the skin; grapes 0.4, plums 1.4, peaches 14",
          {.maximum = 1000, .above = 0});
    t.add("sun_direction", "1", &P::sun_direction,
          "x, y, z of where the sun stands, y being the fruit's axis; empty: no sun");
    t.add("sun_warming_k", "K", &P::sun_warming_k, "how much warmer than the air skin is that faces the sun",
          {.minimum = 0, .maximum = 40});
    t.add_choice("sunshine", &P::sunshine, {"day", "always"},
                 "from 6 to 18 o'clock, strongest at noon; or always");
    t.add(
        "shades", "1", &P::shades,
        "leaves and neighbours, five numbers each: x, y, z of their direction from the fruit's middle, half "
        "their angle in degrees, and what they multiply transpiration by; the sun does not reach there");
    t.add("map", "file", &P::map,
          "square PNG over the skin's texture coordinates that multiplies transpiration: white 1, black 0");
}

void check_moisture(const DryingParameters& parameters) {
    const MoistureParameters& p = parameters.moisture;
    if (!p.on()) {
        if (!parameters.output.hours.empty())
            throw InputError("output.hours needs a drying by the hour: set moisture.hours, or take it out");
        return;
    }
    water::climate_of(parameters.climate);
    if (parameters.drying.rewet > 0)
        throw InputError("drying.rewet is for a given shrinkage: take it or moisture.hours out");
    if (!parameters.output.shrinkages.empty())
        throw InputError(
            "output.shrinkages cannot be told beforehand where moisture.hours is set: give output.hours");
    for (const double hour : parameters.output.hours)
        if (hour > p.hours)
            throw InputError(
                fmt::format("output.hours holds {}, beyond the end of the drying: raise moisture.hours (now "
                            "{}) or take it out",
                            hour, p.hours));
    if (!p.sun_direction.empty() && (p.sun_direction.size() != 3 || !(length_of(p.sun_direction) > 0)))
        throw InputError("moisture.sun_direction must be three numbers, not all 0, or empty for no sun");
    if (p.shades.size() % kNumbersPerShade != 0)
        throw InputError(
            fmt::format("moisture.shades must have five numbers for each shade (x, y, z, half angle in "
                        "degrees, factor); it has {}",
                        p.shades.size()));
    for (const Shade& shade : shades_of(p)) {
        if (!(length_of(shade.direction) > 0))
            throw InputError("moisture.shades has a direction 0, 0, 0: say where the shade is");
        if (!(shade.half_angle_deg > 0 && shade.half_angle_deg <= 180))
            throw InputError(fmt::format("moisture.shades has a half angle of {} degrees: give 0 to 180",
                                         shade.half_angle_deg));
        if (!(shade.factor >= 0))
            throw InputError(fmt::format(
                "moisture.shades has a factor of {}: give 0 (nothing leaves) or more", shade.factor));
    }
}

}  // namespace windfall::drying
