#pragma once
// Parameters of rotting fruit (Kider, Raja, Badler 2011, Tables 1-3, and what goes beyond them).
#include <cstdint>
#include <string>
#include <vector>

#include "core/parameter.h"
#include "decay/fruit_surfaces.h"
#include "water/climate_settings.h"

namespace windfall::decay {

enum class UpAxis { Y, Z };
enum class MeshUvs { Own, Atlas };

struct FruitParameters {
    FruitKind kind = FruitKind::Orange;
    std::string mesh;  ///< file of kind "mesh"
    UpAxis up = UpAxis::Y;
    MeshUvs uvs = MeshUvs::Own;
    double mass_kg = 0.140, water_kg = 0.122;
    double firmness = 40, thickness = 60, porosity = 60;
};

struct WaterParameters {
    double transpiration_ug_s_m2_pa = 8.48;  ///< K
    double rot_leak = 2;                     ///< times as fast where the skin is rotten
};

enum class GrowthForm { Kawasaki, Logistic };

struct GrowthParameters {
    std::string soft_rot = "erwinia";
    std::string fungi = "penicillium-digitatum";  ///< names with commas
    GrowthForm form = GrowthForm::Kawasaki;
    double growth = 50;      ///< 0..100, Table 2
    double propagation = 3;  ///< 0..9
    double reach_m = 0.012;
    double nutrient = 1, nutrient_noise = 0.15, nutrient_noise_m = 0.004;
    double edge_noise = 0.6, edge_noise_m = 0.0025, step_noise = 0.5;
};

struct StartParameters {
    std::int64_t random = 2;  ///< wounds at places drawn from the seed
    bool contacts = true, stem = false;
    std::vector<double> wounds_m;  ///< x, y, z of each on the standing fruit
    std::string mask;              ///< picture whose white marks wounds
    std::int64_t mask_wounds = 12;
    double radius_m = 0.0015;
};

struct BodyParameters {
    double shrinking = 0.6;  ///< c: weight of the lost water's volume
    double softening = 0.1;  ///< modulus at the end over the fresh one
    double softening_days = 21;
    double rot_shrinkage = 0.35, rot_softening = 20, rot_depth_m = 0.010;
    double skin_modulus_pa = 10e6;
    double wrinkle_m = 0;  ///< 0: from thickness and moduli
    std::int64_t skin_cells = 41, flesh_cells = 10;
};

enum class PileGround { Table, Bowl };

struct PileParameters {
    std::int64_t count = 1;
    PileGround ground = PileGround::Table;
    double bowl_radius_m = 0.16, bowl_height_m = 0.07;
    double variation = 0.06;  ///< of the fruits' sizes
};

struct OutputParameters {
    std::int64_t frames = 501;
    double hours_per_frame = 1;
    std::int64_t texels = 512;
    bool flesh = true, shading_maps = false;
    std::int64_t hair = 0;  ///< strands in the frames
};

struct DecayParameters {
    FruitParameters fruit;
    water::ClimateParameters climate;
    WaterParameters water;
    GrowthParameters growth;
    StartParameters start;
    BodyParameters body;
    PileParameters pile;
    OutputParameters output;
    std::uint64_t seed = 1;
};

/// Every parameter of a recipe of decay.
const ParameterTable<DecayParameters>& decay_parameters();

/// Checks between parameters. Throws InputError, naming the keys.
void check(const DecayParameters& parameters);

/// The names in growth.fungi, in order, without blanks.
std::vector<std::string> fungus_names(const GrowthParameters& growth);

}  // namespace windfall::decay
