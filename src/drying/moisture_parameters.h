#pragma once
// Parameters of drying by the hour: the table [moisture].
#include <string>
#include <vector>

#include "core/parameter.h"

namespace windfall::drying {

struct DryingParameters;

enum class Sunshine { Day, Always };

struct MoistureParameters {
    double hours = 0;  ///< 0: no moisture, the shrinkage is given
    double start_hour = 0;
    double diffusivity_m2_s = 5e-10;
    double water = 0.8;  ///< of the fresh flesh's mass
    double solids_kg_m3 = 1550;
    double transpiration_ug_s_m2_pa = 0.4;
    std::vector<double> sun_direction;
    double sun_warming_k = 10;
    Sunshine sunshine = Sunshine::Day;
    std::vector<double> shades;
    std::string map;

    bool on() const { return hours > 0; }
    /// Volume of solids over that of the fresh flesh, which has no pores.
    double solids_fraction() const;
};

/// A place of the skin that less water leaves: a leaf, a neighbour.
struct Shade {
    std::vector<double> direction;  ///< from the fruit's middle: x, y, z
    double half_angle_deg = 0;
    double factor = 1;  ///< of the transpiration
};
std::vector<Shade> shades_of(const MoistureParameters& parameters);

/// Declares the keys of [moisture] and [climate].
void add_moisture(ParameterTable<DryingParameters>& table);

/// Checks between parameters. Throws InputError, naming the keys.
void check_moisture(const DryingParameters& parameters);

}  // namespace windfall::drying
