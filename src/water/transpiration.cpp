#include "water/transpiration.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "water/vapour_pressure.h"

namespace windfall::water {

double transpiration_kg_per_s(const Transpiration& skin) {
    constexpr double kKgPerMicrogram = 1e-9;
    const double surface_pa = skin.sap_vapour_ratio * saturation_pressure_pa(skin.surface_c);
    const double air_pa = vapour_pressure_pa(skin.air_c, skin.relative_humidity);
    return std::max(0.0,
                    kKgPerMicrogram * skin.coefficient_ug_s_m2_pa * skin.area_m2 * (surface_pa - air_pa));
}

double ball_area_m2(double mass_kg, double density_kg_m3) {
    // A = (36 pi)^(1/3) V^(2/3)
    return std::cbrt(36 * std::numbers::pi) * std::pow(mass_kg / density_kg_m3, 2.0 / 3);
}

}  // namespace windfall::water
