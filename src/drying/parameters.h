#pragma once
// Every number and choice of a drying run. The defaults here are the only ones; the table built from them
// (drying_parameters) is what recipes are checked against and what --help, the schema and the docs print.
#include <cstdint>
#include <string>
#include <vector>

#include "core/parameter.h"
#include "drying/moisture_parameters.h"
#include "water/climate_settings.h"

namespace windfall::drying {

/// What a fruit that is an artist's mesh has at its core.
enum class StoneKind { Made, None, Ellipsoid, Mesh };

/// Whose vertices and texture coordinates the take has.
enum class TakeSkin { Own, Atlas };

/// The ten numbers of Liu et al. 2015, eq. (8), (9), in units of r_1 (the south pole's radius), and the real
/// size; or an artist's mesh in place of r_2 .. r_8, whose r_1 is the radius of the ball of its volume.
struct FruitParameters {
    double r2 = 1, r3 = 1, r4 = 1, r5 = 1, r6 = 1, r7 = 1;
    double r8 = 1;
    double stone_r1 = 0.4, stone_r2 = 0.4;
    double skin_thickness = 0.04;
    double size_m = 0.015;
    std::string mesh;  ///< file; empty: the ten numbers
    double unit_m = 1;
    StoneKind stone = StoneKind::Made;
    std::string stone_mesh;
    TakeSkin uvs = TakeSkin::Own;
};

struct MaterialParameters {
    double gamma = 10;
    double bulk_ratio = 50;
};

struct ShrinkageParameters {
    double shrinkage = 0.3;
    double rewet = 0;
    double skin_fraction = 0;
    double radial = 1, meridional = 1, latitudinal = 1;
};

struct SegmentParameters {
    std::int64_t count = 0;
    double wall_width = 0.15;
    double wall_stiffness = 10;
    double wall_shrinkage = 0.3;
};

/// Which way fibres run, and where there are any.
enum class FibreDirection { None, Radial, Meridional, Latitudinal };
enum class FibreLayer { Flesh, Skin, Both };

struct FibreParameters {
    FibreDirection direction = FibreDirection::None;
    FibreLayer layer = FibreLayer::Flesh;
    double stiffness = 10;
    double shrinkage = 1;
    bool on() const { return direction != FibreDirection::None && stiffness > 0; }
};

struct PlasticParameters {
    double flesh_yield_strain = 0;
    double skin_yield_strain = 0;
};

struct ContactParameters {
    double gap = 0;
    double stiffness = 50;
};

struct MeshParameters {
    std::int64_t n = 0;
    double elongation = 0;
    double edge_over_te = 0.75;
    std::int64_t layers = 0;
    std::int64_t skin_layers = 2;
    double growth = 0;
};

enum class ImperfectionKind { Noise, Modes, None };

struct ImperfectionParameters {
    ImperfectionKind kind = ImperfectionKind::Noise;
    double amplitude = 0.001;
    double longest_wave = 2.8;
    double shortest_wave = 0.36;
    std::int64_t modes = 16;
    double linearize_at = 0;
};

struct SolverParameters {
    double max_step = 0.01;
    double viscosity = 1;
    double late_viscosity = 3;
    double newton_tolerance = 0.1;
};

struct OutputParameters {
    std::int64_t frames = 7;
    std::vector<double> shrinkages;
    std::vector<double> hours;
};

struct DryingParameters {
    std::int64_t seed = 1;
    FruitParameters fruit;
    MaterialParameters material;
    ShrinkageParameters drying;
    MoistureParameters moisture;
    water::ClimateParameters climate;
    SegmentParameters segments;
    FibreParameters fibres;
    PlasticParameters plastic;
    ContactParameters contact;
    MeshParameters mesh;
    ImperfectionParameters imperfection;
    SolverParameters solver;
    OutputParameters output;
};

/// The table that declares every parameter of drying: key, unit, range, default, documentation.
const ParameterTable<DryingParameters>& drying_parameters();

/// Checks what no single range can say: a stone that pierces the skin, a shape that folds, frames beyond the
/// end. Throws InputError with the keys concerned and the remedy.
void check(const DryingParameters& parameters);

/// The shrinkages at which frames are taken: from 0 up to `drying.shrinkage`, and from there down again as
/// far as the fruit is rewetted. All three are among them.
std::vector<double> frame_shrinkages(const DryingParameters& parameters);

/// The path's parameters at which frames are taken: hours where the fruit dries by the hour, else shrinkages.
std::vector<double> frame_parameters(const DryingParameters& parameters);

}  // namespace windfall::drying
