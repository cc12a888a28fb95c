#pragma once
// Parameters of a broken or cracked branch (Yang, Yang, Yang 2019, Table 2, and what goes beyond it).
#include <cstdint>
#include <vector>

#include "core/parameter.h"

namespace windfall::fracture {

/// The branch as a lattice of particles. Lengths in radii of the branch at the break, angles in degrees.
struct BranchParameters {
    double diameter_m = 0.01;    ///< D
    std::int64_t rings = 96;     ///< N_ring
    std::int64_t sectors = 320;  ///< N_sec
    std::int64_t layers = 48;    ///< N_layer: rows of particles along each end
    double length = 4;           ///< of the stub, below the break
    double piece_length = 4;     ///< of the fallen piece, above the break
    double taper = 0.03;         ///< relative loss of radius per radius of length
    double bend_deg = 0;         ///< turn of the axis from end to end
    double bark_relief = 0.03;   ///< depth of the furrows
    double bark_scale = 1;       ///< size of the plates of the bark; 1: about seven around
    double outline = 0.06;       ///< how far the cross-section is from a circle
};

/// Shares of the radius; sapwood takes what is left.
struct TissueParameters {
    double pith = 0.05, heartwood = 0.45, phloem = 0.08;
};

enum class HeightSource { Amplitudes, Asked, Species };
enum class EndKind { Broken, Cut };

struct BreakParameters {
    EndKind end = EndKind::Broken;
    double tilt_deg = 0;            ///< phi
    double tilt_direction_deg = 0;  ///< the side that stands high
    HeightSource height_from = HeightSource::Amplitudes;
    double mean_height = 1;  ///< above the lowest point, in radii
    double gap = 0;          ///< between the two ends, along the axis
};

/// A sector that stands higher or lower (eqs. 2-5).
struct LayerParameters {
    double height = 0, angle_deg = 0, width_deg = 0, depth = 0;  ///< h, alpha, theta, mu
};

struct RoughnessParameters {
    double phloem = 0.06, sapwood = 0.02, heartwood = 0.02;                              ///< lambda
    double phloem_frequency = 2000, sapwood_frequency = 400, heartwood_frequency = 200;  ///< beta, 1/m
    std::int64_t octaves = 2;        ///< of Perlin noise, each twice as fine and half as high
    std::int64_t white_octaves = 0;  ///< of noise per particle, each half as high
};

/// Thorns by tissue (L and P of eq. 8) ...
struct ThornParameters {
    double pith_length = 0, pith_probability = 0;
    double heartwood_length = 0, heartwood_probability = 0;
    double sapwood_length = 0, sapwood_probability = 0;
    double phloem_length = 0, phloem_probability = 0;
    double skew = 1;  ///< lengths are L u^skew: 1 as in the paper, 2 gives few long ones
};

/// ... and in the zone that was under tension (eqs. 6, 7).
struct DuctileParameters {
    double length = 0, probability = 0, angle_deg = 0, width_deg = 0, depth = 0;
};

/// Fibre bundles, coarse to fine; the lists have one entry a level. No level: the paper's height model alone.
struct BundleParameters {
    std::vector<double> radial, angular;   ///< size along the ray and along the ring
    std::vector<double> amplitude, slope;  ///< of the bundles' heights and of their planes
    double skew = 1.5;                     ///< heights go with u^skew: large, few are tall
    double terraces = 0.8;         ///< 1: a coarse plane is flat over each finer bundle; 0: it slopes on
    double warp = 0.05;            ///< how far bundles wander from rays and rings
    double warp_frequency = 2;     ///< waves of that per radius
    double compression = 1;        ///< amplitude on the side that was pressed; 1: the same all over
    double bark_amplitude = 0.15;  ///< of the torn edge of the bark
    double bark_offset = 0;        ///< of the bark against the wood
};

/// Torn single fibres, and strips of bark that peel off; both stand out only once the ends are apart.
struct FringeParameters {
    std::int64_t strands = 0;
    double strand_length = 1, strand_thickness = 0.012, strand_curl = 0.4;
    std::int64_t strips = 0;
    double strip_length = 1, strip_width = 0.4, strip_curl = 1;
};

enum class LoadSource { ByHand, Bending };

/// What broke the branch. By bending, the tension side, the neutral axis and the ductile zone follow.
struct LoadParameters {
    LoadSource source = LoadSource::ByHand;
    double direction_deg = 180;  ///< towards which the free end was pushed; tension is on the other side
    double twist = 0;            ///< twisting over bending moment; turns the break's plane
};

enum class SpeciesName { Custom, Juniperus, JuniperusChinensis, Ailanthus, Koelreuteria };
enum class Moisture { Dry, Wet };

struct SpeciesParameters {
    SpeciesName name = SpeciesName::Custom;
    Moisture moisture = Moisture::Dry;
    /// of a custom wood, for the height law
    double density_g_cm3 = 0.61, bending_strength_mpa = 77.6, bending_modulus_gpa = 8.13,
           splitting_strength_kgf_cm = 6.7;
    double shrinkage_radial = 0.0242, shrinkage_tangential = 0.0324;
};

/// One class of cracks by its statistics: how many, and means of gap between neighbours, length, depth,
/// width.
struct CrackClass {
    std::int64_t count = 0;
    double gap_deg = 0;  ///< mean angle between neighbours; 0: even around
    double length = 0.4, depth = 0.3;
    double width = 0.02;  ///< half opening at the middle: rad for radial cracks, radii for tangential ones
};

struct CrackParameters {
    CrackClass large, medium, small;  ///< radial
    CrackClass tangential;            ///< along rings
    bool check = false;               ///< the one big check that reaches the bark
    double check_angle_deg = 60;
    double check_depth = 1.1;
    double check_relief = 0.45;   ///< its opening over (tangential - radial shrinkage) 2 pi
    double irregularity = 0.035;  ///< random radial and tangential displacement of all rays and rings
};

/// Whose wood it looks like. Species: that of species.name (a plain pale wood where that is Custom).
enum class WoodKind {
    Species,
    Plain,
    Juniperus,
    JuniperusChinensis,
    Ailanthus,
    Koelreuteria,
    Oak,
    Pine,
    Green
};

/// The colours of wood and bark, sRGB as typed (0 .. 1). What is empty or 0 is as the palette of `wood` has
/// it (wood_palette.h).
struct WoodColours {
    WoodKind wood = WoodKind::Species;
    std::vector<double> pith, heartwood, sapwood, inner_bark, bark;
    double ring_width = 0;  ///< mean width of the annual rings, in radii
    double late_wood = 1;   ///< darkness of the rings' late wood (of the pores, in oak), times the palette's
    double variation = 1;   ///< between fibre bundles, times the palette's
    double streaks = 1;     ///< along the fibres, times the palette's
    double wetness = 1;  ///< of wet wood (species.moisture): how much darker it is, and greener at the bark
    double weathering = 0.1;  ///< 0 fresh .. 1 grey
};

enum class PiecePlace { Above, Beside, Hidden };
enum class Motion { Still, Breaking };

struct OutputParameters {
    PiecePlace piece = PiecePlace::Beside;
    Motion motion = Motion::Still;
    std::int64_t frames = 48;  ///< of the breaking
    double seconds = 2;        ///< that the breaking takes, until the piece has fallen
};

struct FractureParameters {
    std::int64_t seed = 1;
    BranchParameters branch;
    TissueParameters tissue;
    BreakParameters fracture;
    LayerParameters high, low;
    RoughnessParameters roughness;
    ThornParameters thorns;
    DuctileParameters ductile;
    BundleParameters bundles;
    FringeParameters fringe;
    LoadParameters load;
    SpeciesParameters species;
    CrackParameters cracks;
    WoodColours colours;
    OutputParameters output;
};

/// The table that declares every parameter of fracture: key, unit, range, default, documentation.
const ParameterTable<FractureParameters>& fracture_parameters();

/// Checks what no single range can say: tissues that take more than the radius, bundle lists of different
/// lengths, a break of absurd height, a bend that folds. Throws InputError with the keys concerned and the
/// remedy.
void check(const FractureParameters& parameters);

/// What `check` can only guess, once the broken surface is there: `lowest` and `highest` are its z in the
/// unplaced branch, holes included. Throws InputError where the break is absurdly high, the thin end would
/// vanish or a bend fold.
void check_heights(const FractureParameters& parameters, double lowest, double highest);

}  // namespace windfall::fracture
