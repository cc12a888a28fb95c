#pragma once
// Water that leaves through a skin: Kider, Raja, Badler 2011, eq. (10), after K. V. Chau and J. J. Gaffney
// 1985.

namespace windfall::water {

/// Vapour pressure at the evaporating surface over that of pure water (0.98 .. 0.99: sap is a thin solution).
inline constexpr double kSapVapourRatio = 0.98;

/// A skin and the air around it.
struct Transpiration {
    double coefficient_ug_s_m2_pa = 0;  ///< K: micrograms per second, square metre and pascal
    double area_m2 = 0;                 ///< of the skin
    double surface_c = 20;              ///< temperature of the skin, degrees C
    double air_c = 20;                  ///< temperature of the air, degrees C
    double relative_humidity = 0.5;     ///< of the air, 0..1
    double sap_vapour_ratio = kSapVapourRatio;
};

/// kg of water lost per second: K A (ratio Psat(surface) - RH Psat(air)). Never negative: a skin does not
/// drink from damp air.
double transpiration_kg_per_s(const Transpiration& skin);

/// Area in m2 of a ball of that mass and density: the skin of a fruit of which no more is known.
double ball_area_m2(double mass_kg, double density_kg_m3 = 1000);

}  // namespace windfall::water
