#include "water/vapour_pressure.h"

#include <cmath>

namespace windfall::water {

double saturation_pressure_pa(double temperature_c) {
    constexpr double kSteamPoint_k = 373.16;
    constexpr double kSteamPressure_pa = 101324.6;
    // The formula's own scale, of 1946, has ice melt at 273.16 K and water boil at 373.16 K.
    const double temperature_k = temperature_c + 273.16;
    const double ratio = kSteamPoint_k / temperature_k;
    const double exponent = -7.90298 * (ratio - 1) + 5.02808 * std::log10(ratio) -
                            1.3816e-7 * (std::pow(10, 11.344 * (1 - 1 / ratio)) - 1) +
                            8.1328e-3 * (std::pow(10, -3.49149 * (ratio - 1)) - 1);
    return kSteamPressure_pa * std::pow(10, exponent);
}

double vapour_pressure_pa(double temperature_c, double relative_humidity) {
    return relative_humidity * saturation_pressure_pa(temperature_c);
}

}  // namespace windfall::water
