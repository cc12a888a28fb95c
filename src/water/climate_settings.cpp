#include "water/climate_settings.h"

#include <fmt/format.h>

#include "core/error.h"

namespace windfall::water {

Climate climate_of(const ClimateParameters& parameters) {
    switch (parameters.name) {
        case ClimateName::Temperate:
            return named_climate("temperate");
        case ClimateName::Tropical:
            return named_climate("tropical");
        case ClimateName::ColdDesert:
            return named_climate("cold-desert");
        case ClimateName::HotDesert:
            return named_climate("hot-desert");
        case ClimateName::Fridge:
            return named_climate("fridge");
        case ClimateName::Constant:
            return constant_climate(parameters.temperature_c, parameters.humidity);
        case ClimateName::Table:
            break;
    }
    const std::size_t rows = parameters.hours.size();
    if (rows == 0 || parameters.temperatures_c.size() != rows || parameters.humidities.size() != rows)
        throw InputError(
            fmt::format("climate.hours, climate.temperatures_c and climate.humidities must have as many "
                        "numbers each, at least one; they have {}, {} and {}",
                        rows, parameters.temperatures_c.size(), parameters.humidities.size()));
    std::vector<ClimateRow> table(rows);
    for (std::size_t i = 0; i < rows; ++i)
        table[i] = {parameters.hours[i], parameters.temperatures_c[i], parameters.humidities[i]};
    return Climate(std::move(table));
}

}  // namespace windfall::water
