#pragma once
// Saturation vapour pressure of water: J. A. Goff and S. Gratch, Low-pressure properties of water from -160
// to 212 F, Trans. ASHVE 52, 1946, with the steam point of the Smithsonian tables (373.16 K, 1013.246 hPa).

namespace windfall::water {

/// Pressure in Pa of vapour in equilibrium with liquid water at `temperature_c` (degrees C, -50 .. 102).
/// Below freezing it is that over supercooled water.
double saturation_pressure_pa(double temperature_c);

/// Pressure in Pa of the vapour in air of that temperature and relative humidity (0..1).
double vapour_pressure_pa(double temperature_c, double relative_humidity);

}  // namespace windfall::water
