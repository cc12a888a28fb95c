#pragma once
// The measured woods, and the height at which a branch of a wood breaks (Yang, Yang, Yang 2019, Table 1, eq.
// 9).
#include <string>
#include <vector>

#include "fracture/parameters.h"

namespace windfall::fracture {

/// Physical and mechanical properties of a wood, air-dried.
struct WoodProperties {
    double density_g_cm3 = 0;     ///< rho
    double shrinkage_radial = 0;  ///< from green to dry, relative
    double shrinkage_tangential = 0;
    double compressive_strength_mpa = 0;  ///< along the grain
    double bending_strength_mpa = 0;      ///< R_B
    double bending_modulus_gpa = 0;       ///< E_B
    double end_hardness_n = 0;
    double splitting_strength_kgf_cm = 0;  ///< R_C
};

/// A wood whose broken branches were measured.
struct MeasuredWood {
    SpeciesName name;
    std::string common_name, botanical_name;
    WoodProperties properties;
    double measured_height;  ///< mean height of the broken surface, in radii
};

/// The four woods of the paper, in the order of SpeciesName from Juniperus on.
const std::vector<MeasuredWood>& measured_woods();

/// The measured wood of that name; null for SpeciesName::Custom.
const MeasuredWood* measured_wood(SpeciesName name);

/// Properties of the recipe's wood: the measured ones, or, for a custom wood, those that the recipe gives
/// (compressive strength and hardness, which nothing here depends on, are 0).
WoodProperties wood_properties(const SpeciesParameters& species);

/// Mean height of the broken surface over the radius (eq. 9; the paper writes h = (...) D, and its own four
/// measurements are reproduced with the radius). Four coefficients through four woods: an interpolation,
/// which goes below zero for many others.
double height_law(const WoodProperties& wood);

/// The least and the largest height, in radii, that is taken from the law.
inline constexpr double kLeastHeight = 0.1, kLargestHeight = 20;

/// What sap changes. Wood shrinks only once it has dried below fibre saturation, about 30 % of moisture
/// (Forest Products Laboratory, Wood Handbook, FPL-GTR-282, chapter 4), so that a green log has hardly any
/// cracks; the factors themselves are chosen by eye, not measured.
struct MoistureEffect {
    double fibre_length = 1;  ///< factor on the height of the break: wet fibres are tougher
    double crack_count = 1, crack_width = 1, crack_depth = 1;
};
MoistureEffect moisture_effect(Moisture moisture);

/// Height that `break.height_from = species` asks for, in radii: the law's, longer when the wood is wet.
/// Where a property lies outside the range of the measured woods, or the law's value outside that of the
/// measured heights, a text for people that says what, why and what to do is added to `warnings` (may be
/// null), and the value is held within kLeastHeight .. kLargestHeight.
double asked_mean_height(const FractureParameters& parameters, std::vector<std::string>* warnings);

}  // namespace windfall::fracture
