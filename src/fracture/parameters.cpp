#include "fracture/parameters.h"

#include "core/parameter_group.h"
#include "fracture/parameters_colours.h"

namespace windfall::fracture {

namespace {

using Table = ParameterTable<FractureParameters>;

constexpr ParameterRange kShare = {.minimum = 0, .maximum = 1};
constexpr ParameterRange kAround = {.minimum = 0, .maximum = 360};
constexpr ParameterRange kThornLength = {.minimum = 0, .maximum = 40};
constexpr ParameterRange kSkew = {.minimum = 0.1, .maximum = 10};

void add_branch(Table& table) {
    using P = BranchParameters;
    ParameterGroup t(table, "branch", &FractureParameters::branch);
    t.add("diameter_m", "m", &P::diameter_m,
          "real diameter D at the break; the noise frequencies are per metre of it",
          {.minimum = 1e-4, .maximum = 5});
    t.add("rings", "1", &P::rings, "rings of particles from the pith out: finer, the same break",
          {.minimum = 3, .maximum = 400});
    t.add("sectors", "1", &P::sectors,
          "particles around each ring; about three times the rings for slender bundles",
          {.minimum = 10, .maximum = 1000});
    t.add("layers", "1", &P::layers, "rows of particles along each end, for its bark",
          {.minimum = 2, .maximum = 400});
    const ParameterRange length = {.maximum = 100, .above = 0};
    t.add("length", "radii", &P::length, "length of the stub below the break", length);
    t.add("piece_length", "radii", &P::piece_length, "length of the fallen piece above the break", length);
    t.add("taper", "1", &P::taper, "loss of radius per length, upwards", {.minimum = 0, .maximum = 0.2});
    t.add("bend_deg", "deg", &P::bend_deg, "turn of the branch's axis from end to end",
          {.minimum = -180, .maximum = 180});
    t.add("bark_relief", "radii", &P::bark_relief, "depth of the bark's furrows; 0: smooth bark",
          {.minimum = 0, .maximum = 0.3});
    t.add("bark_scale", "1", &P::bark_scale, "size of the bark's plates; 1: about seven around",
          {.minimum = 0.1, .maximum = 10});
    t.add("outline", "radii", &P::outline, "how far the cross-section is from a circle",
          {.minimum = 0, .maximum = 0.3});
}

void add_tissue(Table& table) {
    using P = TissueParameters;
    ParameterGroup t(table, "tissue", &FractureParameters::tissue);
    t.add("pith", "1", &P::pith, "share of the radius that is pith", kShare);
    t.add("heartwood", "1", &P::heartwood, "share that is heartwood; sapwood takes what is left", kShare);
    t.add("phloem", "1", &P::phloem, "share that is phloem, the inner bark", kShare);
}

void add_break(Table& table) {
    using P = BreakParameters;
    ParameterGroup t(table, "break", &FractureParameters::fracture);
    t.add_choice("end", &P::end, {"broken", "cut"},
                 "a broken branch, or a sawn log whose upper end is flat and shows the cracks");
    t.add("tilt_deg", "deg", &P::tilt_deg, "tilt of the broken surface, phi; 0: straight across",
          {.minimum = 0, .below = 90});
    t.add("tilt_direction_deg", "deg", &P::tilt_direction_deg, "the side of the stub that stands high",
          kAround);
    t.add_choice("height_from", &P::height_from, {"amplitudes", "asked", "species"},
                 "height of the break: as roughness, bundles and thorns make it, scaled to "
                 "break.mean_height, or scaled to the height law of the species");
    t.add("mean_height", "radii", &P::mean_height,
          "asked: mean height of the broken surface above its lowest point", {.minimum = 0, .maximum = 40});
    t.add("gap", "radii", &P::gap, "distance of the two ends along the axis; 0: they fit together",
          {.minimum = 0, .maximum = 100});
}

void add_layer(Table& table, const std::string& name, LayerParameters FractureParameters::*layer,
               const ParameterRange& heights, const std::string& what) {
    using P = LayerParameters;
    ParameterGroup t(table, name, layer);
    t.add("height", "radii", &P::height, "how much " + what + ", h", heights);
    t.add("angle_deg", "deg", &P::angle_deg, "middle of that sector, alpha", kAround);
    t.add("width_deg", "deg", &P::width_deg, "width of that sector, theta; 0: there is none", kAround);
    t.add("depth", "1", &P::depth, "share of the rings that it takes, from the bark inwards, mu", kShare);
}

void add_roughness(Table& table) {
    using P = RoughnessParameters;
    ParameterGroup t(table, "roughness", &FractureParameters::roughness);
    const ParameterRange lambda = {.minimum = 0, .maximum = 5};
    t.add("phloem", "radii", &P::phloem, "height of the noise in phloem, lambda", lambda);
    t.add("sapwood", "radii", &P::sapwood, "height of the noise in sapwood", lambda);
    t.add("heartwood", "radii", &P::heartwood, "height of the noise in heartwood and pith", lambda);
    const ParameterRange beta = {.minimum = 1, .maximum = 10000};
    t.add("phloem_frequency", "1/m", &P::phloem_frequency,
          "frequency of the noise in phloem, beta; near the lattice's own it is noise per particle", beta);
    t.add("sapwood_frequency", "1/m", &P::sapwood_frequency, "frequency of the noise in sapwood", beta);
    t.add("heartwood_frequency", "1/m", &P::heartwood_frequency,
          "frequency of the noise in heartwood and pith", beta);
    const ParameterRange octaves = {.minimum = 0, .maximum = 8};
    t.add("octaves", "1", &P::octaves, "octaves of Perlin noise, each twice as fine and half as high",
          octaves);
    t.add("white_octaves", "1", &P::white_octaves, "octaves of noise per particle, each half as high",
          octaves);
}

void add_thorns(Table& table) {
    using P = ThornParameters;
    ParameterGroup t(table, "thorns", &FractureParameters::thorns);
    const auto add_tissue_thorns = [&](const std::string& name, double P::*length, double P::*probability) {
        t.add(name + "_length", "radii", length, "longest thorn in " + name + ", L", kThornLength);
        t.add(name + "_probability", "1", probability,
              "share of the cells in " + name + " that carry a thorn, P", kShare);
    };
    add_tissue_thorns("pith", &P::pith_length, &P::pith_probability);
    add_tissue_thorns("heartwood", &P::heartwood_length, &P::heartwood_probability);
    add_tissue_thorns("sapwood", &P::sapwood_length, &P::sapwood_probability);
    add_tissue_thorns("phloem", &P::phloem_length, &P::phloem_probability);
    t.add("skew", "1", &P::skew, "1: all lengths are as frequent; 2: few are long", kSkew);
}

void add_ductile(Table& table) {
    using P = DuctileParameters;
    ParameterGroup t(table, "ductile", &FractureParameters::ductile);
    t.add("length", "radii", &P::length, "longest thorn on the side that was under tension, L_D",
          kThornLength);
    t.add("probability", "1", &P::probability, "share of the cells there that carry a thorn, P_D", kShare);
    t.add("angle_deg", "deg", &P::angle_deg, "middle of that side, alpha_D", kAround);
    t.add("width_deg", "deg", &P::width_deg, "width of that side, theta_D; 0: there is none", kAround);
    t.add("depth", "1", &P::depth, "share of the rings that it takes, from the bark inwards, mu_D", kShare);
}

void add_bundles(Table& table) {
    using P = BundleParameters;
    ParameterGroup t(table, "bundles", &FractureParameters::bundles);
    const ParameterRange size = {.minimum = 0.005, .maximum = 6.3};
    t.add("radial", "radii", &P::radial,
          "size of the fibre bundles along the ray, an entry a level, coarse to fine; []: no bundles", size);
    t.add("angular", "radii", &P::angular, "their size along the ring, an entry a level", size);
    t.add("amplitude", "radii", &P::amplitude,
          "how far they stand out, an entry a level; at most half their size, or three times it and more",
          {.minimum = 0, .maximum = 20});
    t.add("slope", "1", &P::slope, "how steeply they break off, an entry a level",
          {.minimum = 0, .maximum = 20});
    t.add("skew", "1", &P::skew, "1: all heights are as frequent; 2: few bundles are tall", kSkew);
    t.add("terraces", "1", &P::terraces,
          "1: the plane of a coarse bundle is flat over each finer one; 0: it slopes on", kShare);
    t.add("warp", "radii", &P::warp, "how far bundles wander from rays and rings",
          {.minimum = 0, .maximum = 0.5});
    t.add("warp_frequency", "1/radius", &P::warp_frequency, "waves of that", {.minimum = 0.1, .maximum = 20});
    t.add("compression", "1", &P::compression,
          "amplitude on the side that was pressed, over that under tension; 1: the same all over", kShare);
    t.add("bark_amplitude", "radii", &P::bark_amplitude, "raggedness of the bark's torn edge",
          {.minimum = 0, .maximum = 5});
    t.add("bark_offset", "radii", &P::bark_offset, "how far the bark stands above the wood; < 0: below",
          {.minimum = -5, .maximum = 5});
}

void add_fringe(Table& table) {
    using P = FringeParameters;
    ParameterGroup t(table, "fringe", &FractureParameters::fringe);
    const ParameterRange length = {.maximum = 20, .above = 0}, curl = {.minimum = 0, .maximum = 10};
    t.add("strands", "1", &P::strands, "torn single fibres; they stand out once the ends are apart",
          {.minimum = 0, .maximum = 5000});
    t.add("strand_length", "radii", &P::strand_length, "length of the longest", length);
    t.add("strand_thickness", "radii", &P::strand_thickness, "their thickness at the root",
          {.maximum = 0.2, .above = 0});
    t.add("strand_curl", "1", &P::strand_curl, "how much they bend over their length", curl);
    t.add("strips", "1", &P::strips, "strips of bark that peel off", {.minimum = 0, .maximum = 60});
    t.add("strip_length", "radii", &P::strip_length, "length of the longest", length);
    t.add("strip_width", "radii", &P::strip_width, "their width around the branch",
          {.maximum = 3, .above = 0});
    t.add("strip_curl", "1", &P::strip_curl, "how much they roll outwards", curl);
}

void add_load(Table& table) {
    using P = LoadParameters;
    ParameterGroup t(table, "load", &FractureParameters::load);
    t.add_choice("source", &P::source, {"by_hand", "bending"},
                 "by_hand: tilt and ductile zone as they are set; bending: from the load, by beam theory");
    t.add("direction_deg", "deg", &P::direction_deg,
          "bending: towards which the free end was pushed; tension is on the other side", kAround);
    t.add("twist", "1", &P::twist, "bending: twisting over bending moment; turns the plane of the break",
          {.minimum = -10, .maximum = 10});
}

void add_species(Table& table) {
    using P = SpeciesParameters;
    ParameterGroup t(table, "species", &FractureParameters::species);
    t.add_choice("name", &P::name,
                 {"custom", "juniperus", "juniperus-chinensis", "ailanthus", "koelreuteria"},
                 "the wood, for the height law and for drying; custom: the numbers below");
    t.add_choice("moisture", &P::moisture, {"dry", "wet"}, "seasoned wood, or green wood with its sap");
    t.add("density_g_cm3", "g/cm3", &P::density_g_cm3, "custom: air-dried density",
          {.maximum = 2, .above = 0});
    t.add("bending_strength_mpa", "MPa", &P::bending_strength_mpa, "custom: bending strength",
          {.maximum = 500, .above = 0});
    t.add("bending_modulus_gpa", "GPa", &P::bending_modulus_gpa, "custom: bending modulus",
          {.maximum = 100, .above = 0});
    t.add("splitting_strength_kgf_cm", "kgf/cm", &P::splitting_strength_kgf_cm,
          "custom: strength against splitting", {.maximum = 200, .above = 0});
    const ParameterRange shrinkage = {.minimum = 0, .maximum = 0.3};
    t.add("shrinkage_radial", "1", &P::shrinkage_radial, "custom: shrinkage along the rays when dried",
          shrinkage);
    t.add("shrinkage_tangential", "1", &P::shrinkage_tangential,
          "custom: shrinkage along the rings when dried; what it exceeds the radial one opens the check",
          shrinkage);
}

void add_cracks(Table& table) {
    using P = CrackParameters;
    const auto add_class = [&](const std::string& name, CrackClass P::*cracks, const std::string& what,
                               double longest, const std::string& width_unit) {
        const auto add = [&](const std::string& key, const std::string& unit, auto member,
                             const std::string& doc, const ParameterRange& range) {
            table.add(
                "cracks." + name + "_" + key, unit,
                [ cracks, member ](auto& p) -> auto& { return p.cracks.*cracks.*member; }, what + doc, range);
        };
        add("count", "1", &CrackClass::count, ": how many", {.minimum = 0, .maximum = 500});
        add("gap_deg", "deg", &CrackClass::gap_deg, ": mean angle between neighbours; 0: even around",
            kAround);
        add("length", "radii", &CrackClass::length, ": mean length", {.maximum = longest, .above = 0});
        add("depth", "radii", &CrackClass::depth, ": mean depth from the end", {.maximum = 20, .above = 0});
        add("width", width_unit, &CrackClass::width, ": mean half opening at the middle",
            {.maximum = 0.5, .above = 0});
    };
    add_class("large", &P::large, "large radial cracks", 1, "rad");
    add_class("medium", &P::medium, "medium radial cracks", 1, "rad");
    add_class("small", &P::small, "small radial cracks", 1, "rad");
    add_class("tangential", &P::tangential, "cracks along the rings", 6.3, "radii");
    ParameterGroup t(table, "cracks", &FractureParameters::cracks);
    t.add("check", "1", &P::check, "the one big check that opens from the pith through the bark");
    t.add("check_angle_deg", "deg", &P::check_angle_deg, "where it is", kAround);
    t.add("check_depth", "radii", &P::check_depth, "its depth from the end", {.maximum = 20, .above = 0});
    t.add("check_relief", "1", &P::check_relief,
          "its opening over what shrinkage would open, (tangential - radial) 360 degrees",
          {.minimum = 0, .maximum = 3});
    t.add("irregularity", "radii", &P::irregularity, "how far rays and rings wander at random",
          {.minimum = 0, .maximum = 0.2});
}

void add_output(Table& table) {
    using P = OutputParameters;
    ParameterGroup t(table, "output", &FractureParameters::output);
    t.add_choice("piece", &P::piece, {"above", "beside", "hidden"},
                 "where the fallen piece is: over the stub at break.gap, beside it, or left out");
    t.add_choice("motion", &P::motion, {"still", "breaking"},
                 "one frame of the broken branch, or the breaking as an animation");
    t.add("frames", "1", &P::frames, "breaking: number of frames", {.minimum = 2, .maximum = 2000});
    t.add("seconds", "s", &P::seconds, "breaking: time until the piece has fallen",
          {.maximum = 60, .above = 0});
}

Table make_fracture_table() {
    Table t;
    t.add("seed", "1", [](auto& p) -> auto& { return p.seed; },
          "of all random numbers; another seed is another break of the same kind",
          {.minimum = 0, .maximum = 9007199254740992.0});
    add_branch(t);
    add_tissue(t);
    add_break(t);
    add_layer(t, "high", &FractureParameters::high, {.minimum = 0, .maximum = 20},
              "a sector of the break stands higher");
    add_layer(t, "low", &FractureParameters::low, {.minimum = -20, .maximum = 0},
              "a sector of the break lies lower (a number below 0)");
    add_roughness(t);
    add_thorns(t);
    add_ductile(t);
    add_bundles(t);
    add_fringe(t);
    add_load(t);
    add_species(t);
    add_cracks(t);
    add_colours(t);
    add_output(t);
    return t;
}

}  // namespace

const ParameterTable<FractureParameters>& fracture_parameters() {
    static const Table kTable = make_fracture_table();
    return kTable;
}

}  // namespace windfall::fracture
