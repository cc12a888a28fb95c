#include "water/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::water {

WaterLedger::WaterLedger(double start_mass_kg, double water_kg)
    : m_start(start_mass_kg), m_start_water(water_kg), m_solids(start_mass_kg - water_kg), m_left(water_kg) {
    if (!(water_kg > 0 && water_kg <= start_mass_kg))
        throw InputError(
            fmt::format("a fruit of {:.4g} g with {:.4g} g of water cannot be: give a mass, and water "
                        "between 0 and that mass",
                        1000 * start_mass_kg, 1000 * water_kg));
}

double WaterLedger::take(double amount_kg) {
    const double taken = std::clamp(amount_kg, 0.0, m_left);
    m_left -= taken;
    m_lost += taken;
    return taken;
}

void WaterLedger::restore(double lost_kg, double water_left_kg) {
    constexpr double kTolerance = 1e-9;  // what the ledger itself promises
    if (!(lost_kg >= 0 && water_left_kg >= 0 &&
          std::abs(lost_kg + water_left_kg - m_start_water) <= kTolerance * m_start))
        throw InputError(
            fmt::format("{:.6g} g lost and {:.6g} g left are not the {:.6g} g of water at the start",
                        1000 * lost_kg, 1000 * water_left_kg, 1000 * m_start_water));
    m_lost = lost_kg;
    m_left = water_left_kg;
}

}  // namespace windfall::water
