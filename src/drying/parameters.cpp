#include "drying/parameters.h"

namespace windfall::drying {

namespace {

using Table = ParameterTable<DryingParameters>;

void add_fruit(Table& t) {
    const ParameterRange radius = {.maximum = 10, .above = 0};
    t.add(
        "fruit.r2", "r_1", [](auto& p) -> auto& { return p.fruit.r2; },
        "radius of the flesh 60 degrees south of the equator; r_1, at the south pole, is 1", radius);
    t.add(
        "fruit.r3", "r_1", [](auto& p) -> auto& { return p.fruit.r3; },
        "radius of the flesh 30 degrees south of the equator", radius);
    t.add(
        "fruit.r4", "r_1", [](auto& p) -> auto& { return p.fruit.r4; },
        "radius of the flesh at the equator, along x; below 1 the fruit is prolate", radius);
    t.add(
        "fruit.r5", "r_1", [](auto& p) -> auto& { return p.fruit.r5; },
        "radius of the flesh 30 degrees north of the equator", radius);
    t.add(
        "fruit.r6", "r_1", [](auto& p) -> auto& { return p.fruit.r6; },
        "radius of the flesh 60 degrees north of the equator", radius);
    t.add(
        "fruit.r7", "r_1", [](auto& p) -> auto& { return p.fruit.r7; },
        "radius of the flesh at the north pole", radius);
    t.add(
        "fruit.r8", "r_1", [](auto& p) -> auto& { return p.fruit.r8; },
        "radius of the flesh at the equator, along z; other than r4 the fruit is flattened, like a plum",
        radius);
    t.add(
        "fruit.stone_r1", "r_1", [](auto& p) -> auto& { return p.fruit.stone_r1; },
        "half axis of the stone along the fruit's axis", radius);
    t.add(
        "fruit.stone_r2", "r_1", [](auto& p) -> auto& { return p.fruit.stone_r2; },
        "half axis of the stone along x (along z it is r8 stone_r2 / r4)", radius);
    t.add("fruit.skin_thickness", "r_1", [](auto& p) -> auto& { return p.fruit.skin_thickness; },
          "thickness t_e of the skin (exocarp); wrinkles grow with it", {.maximum = 0.5, .above = 0});
    t.add("fruit.size_m", "m", [](auto& p) -> auto& { return p.fruit.size_m; },
          "real length of r_1; scales what is exported, not the result", {.maximum = 100, .above = 0});
    t.add(
        "fruit.mesh", "file", [](auto& p) -> auto& { return p.fruit.mesh; },
        "file of a closed mesh (.obj, .ply, .gltf, .glb) that is the fresh fruit, skin included, in place of "
        "r2 .. r8; r_1 is then the radius of the ball of its volume");
    t.add("fruit.unit_m", "m", [](auto& p) -> auto& { return p.fruit.unit_m; },
          "real length of the unit of fruit.mesh, in place of size_m", {.maximum = 1000, .above = 0});
    t.add_choice(
        "fruit.stone", [](auto& p) -> auto& { return p.fruit.stone; }, {"made", "none", "ellipsoid", "mesh"},
        "of fruit.mesh: made: of its own shape, 0.6 of the way in; none: as small a core as the layers "
        "allow; "
        "ellipsoid: stone_r1, stone_r2 about its middle; mesh: stone_mesh");
    t.add(
        "fruit.stone_mesh", "file", [](auto& p) -> auto& { return p.fruit.stone_mesh; },
        "file of a closed mesh inside fruit.mesh, in its place, for fruit.stone = \"mesh\"");
    t.add_choice(
        "fruit.uvs", [](auto& p) -> auto& { return p.fruit.uvs; }, {"own", "atlas"},
        "of fruit.mesh: own: the take has its vertices, faces and texture coordinates; atlas: the solver's "
        "skin, "
        "fine enough for every wrinkle, with texture coordinates of its own");
}

void add_physics(Table& t) {
    t.add("material.gamma", "1", [](auto& p) -> auto& { return p.material.gamma; },
          "shear modulus of the skin over that of the flesh; wrinkles grow with it",
          {.maximum = 1e4, .above = 0});
    t.add("material.bulk_ratio", "1", [](auto& p) -> auto& { return p.material.bulk_ratio; },
          "bulk over shear modulus: 50 for pictures, 200 and more for checks (slower)",
          {.minimum = 5, .maximum = 1e4});
    t.add("drying.shrinkage", "1", [](auto& p) -> auto& { return p.drying.shrinkage; },
          "linear shrinkage of the flesh, 1 - theta, at the end; the flesh keeps (1 - shrinkage)^3 of its "
          "volume. With moisture.hours the most that any flesh shrinks",
          {.minimum = 0.001, .below = 1});
    t.add("drying.rewet", "1", [](auto& p) -> auto& { return p.drying.rewet; },
          "part of the shrinkage that the flesh takes back after drying, swelling with water again; 1: all "
          "of it",
          {.minimum = 0, .maximum = 1});
    t.add("drying.skin_fraction", "1", [](auto& p) -> auto& { return p.drying.skin_fraction; },
          "shrinkage of the skin as a fraction of the flesh's; 1: no wrinkles", {.minimum = 0, .maximum = 1});
    t.add("drying.radial", "1", [](auto& p) -> auto& { return p.drying.radial; },
          "shrinkage across the layers, as a multiple of drying.shrinkage", {.minimum = 0, .maximum = 3});
    t.add("drying.meridional", "1", [](auto& p) -> auto& { return p.drying.meridional; },
          "shrinkage along the meridians, as a multiple of drying.shrinkage", {.minimum = 0, .maximum = 3});
    t.add("drying.latitudinal", "1", [](auto& p) -> auto& { return p.drying.latitudinal; },
          "shrinkage along the circles of latitude, as a multiple of drying.shrinkage",
          {.minimum = 0, .maximum = 3});
}

void add_segments(Table& t) {
    t.add("segments.count", "1", [](auto& p) -> auto& { return p.segments.count; },
          "segments of the flesh around the axis, as in a mandarin (10) or a pepper (4), with a wall between "
          "each two; 0: none",
          {.minimum = 0, .maximum = 100});
    t.add("segments.wall_width", "1", [](auto& p) -> auto& { return p.segments.wall_width; },
          "width of a wall, as a part of the angle of a segment", {.maximum = 1, .above = 0});
    t.add("segments.wall_stiffness", "1", [](auto& p) -> auto& { return p.segments.wall_stiffness; },
          "shear modulus of the walls over that of the flesh", {.minimum = 0.01, .maximum = 1e3});
    t.add("segments.wall_shrinkage", "1", [](auto& p) -> auto& { return p.segments.wall_shrinkage; },
          "shrinkage of the walls as a fraction of the flesh's; the less, the more they stand out as ribs",
          {.minimum = 0, .maximum = 1});
}

void add_fibres(Table& t) {
    t.add_choice(
        "fibres.direction", [](auto& p) -> auto& { return p.fibres.direction; },
        {"none", "radial", "meridional", "latitudinal"},
        "which way fibres run: across the layers, along the meridians (from pole to pole), or along the "
        "circles of latitude; none: there are none");
    t.add_choice(
        "fibres.layer", [](auto& p) -> auto& { return p.fibres.layer; }, {"flesh", "skin", "both"},
        "where they run");
    t.add("fibres.stiffness", "1", [](auto& p) -> auto& { return p.fibres.stiffness; },
          "Young's modulus that they add along themselves, over the shear modulus of the flesh (in the skin: "
          "of the skin), which has about 3 of its own",
          {.minimum = 0, .maximum = 100});
    t.add("fibres.shrinkage", "1", [](auto& p) -> auto& { return p.fibres.shrinkage; },
          "shrinkage of the fibres along themselves as a fraction of the flesh's (in the skin: the skin's); "
          "below 1 they hold the fruit long that way",
          {.minimum = 0, .maximum = 1});
}

void add_plastic(Table& t) {
    t.add("plastic.flesh_yield_strain", "1", [](auto& p) -> auto& { return p.plastic.flesh_yield_strain; },
          "plastic set: equivalent elastic strain from which the flesh keeps a deformation for good; 0: it "
          "never does",
          {.minimum = 0, .maximum = 10});
    t.add("plastic.skin_yield_strain", "1", [](auto& p) -> auto& { return p.plastic.skin_yield_strain; },
          "the same of the skin; with it, wrinkles stay when the fruit is rewetted",
          {.minimum = 0, .maximum = 10});
}

void add_contact(Table& t) {
    t.add("contact.gap", "t_e", [](auto& p) -> auto& { return p.contact.gap; },
          "distance below which folds of the skin press on each other, in skin thicknesses: 0.15 is a good "
          "one; 0: they pass through each other",
          {.minimum = 0, .maximum = 1});
    t.add("contact.stiffness", "C0", [](auto& p) -> auto& { return p.contact.stiffness; },
          "pressure of two flat folds at half the gap, about; larger: folds stay further apart, and more "
          "increments",
          {.minimum = 1e-3, .maximum = 1e3});
}

void add_numerics(Table& t) {
    t.add("mesh.n", "1", [](auto& p) -> auto& { return p.mesh.n; },
          "elements along the shorter sides of the brick that is wrapped around the fruit, a multiple of 8; "
          "0: from "
          "mesh.edge_over_te",
          {.minimum = 0, .maximum = 512});
    t.add("mesh.elongation", "1", [](auto& p) -> auto& { return p.mesh.elongation; },
          "length of the brick over its width, for long fruit; 0: from the fruit's proportions",
          {.minimum = 0, .maximum = 8});
    t.add("mesh.edge_over_te", "1", [](auto& p) -> auto& { return p.mesh.edge_over_te; },
          "mean edge of a surface element over the skin's thickness; above 0.75 the skin grows too stiff",
          {.maximum = 10, .above = 0});
    t.add("mesh.layers", "1", [](auto& p) -> auto& { return p.mesh.layers; },
          "layers of elements from stone to skin, 8 or 16; 0: 8, or 16 where the skin is thin and the flesh "
          "thick",
          {.minimum = 0, .maximum = 16});
    t.add("mesh.skin_layers", "1", [](auto& p) -> auto& { return p.mesh.skin_layers; },
          "layers of elements in the skin; one is too soft in bending", {.minimum = 1, .maximum = 6});
    t.add("mesh.growth", "1", [](auto& p) -> auto& { return p.mesh.growth; },
          "thickness of a flesh layer over that of the next one out; 0: so that the outermost is as thick as "
          "the skin",
          {.minimum = 0, .maximum = 3});
    t.add_choice(
        "imperfection.kind", [](auto& p) -> auto& { return p.imperfection.kind; }, {"noise", "modes", "none"},
        "what starts the wrinkles: band-limited noise, random mix of linear buckling modes, or nothing");
    t.add("imperfection.amplitude", "r_1", [](auto& p) -> auto& { return p.imperfection.amplitude; },
          "largest displacement of the fresh surface, chi", {.minimum = 0, .maximum = 0.1});
    t.add("imperfection.longest_wave", "1", [](auto& p) -> auto& { return p.imperfection.longest_wave; },
          "noise: longest wave, in expected wave lengths of the wrinkles", {.maximum = 100, .above = 0});
    t.add("imperfection.shortest_wave", "1", [](auto& p) -> auto& { return p.imperfection.shortest_wave; },
          "noise: shortest wave, in expected wave lengths of the wrinkles", {.maximum = 100, .above = 0});
    t.add("imperfection.modes", "1", [](auto& p) -> auto& { return p.imperfection.modes; },
          "modes: how many of the lowest buckling modes are mixed", {.minimum = 1, .maximum = 200});
    t.add("imperfection.linearize_at", "1", [](auto& p) -> auto& { return p.imperfection.linearize_at; },
          "modes: shrinkage about which buckling is linearised; 0: 0.6 of the expected critical one",
          {.minimum = 0, .below = 1});
    t.add("solver.max_step", "1", [](auto& p) -> auto& { return p.solver.max_step; },
          "largest increment of shrinkage", {.maximum = 0.1, .above = 0});
    t.add("solver.viscosity", "1", [](auto& p) -> auto& { return p.solver.viscosity; },
          "damping c of the viscous stabilisation, in C0 of the flesh times the time of the whole drying "
          "over r_1^2",
          {.minimum = 0, .maximum = 1000});
    t.add("solver.late_viscosity", "1", [](auto& p) -> auto& { return p.solver.late_viscosity; },
          "the same once wrinkles stand; times (0.375 / expected wave length)^1.5, from 1 to 8",
          {.minimum = 0, .maximum = 1000});
    t.add("solver.newton_tolerance", "1", [](auto& p) -> auto& { return p.solver.newton_tolerance; },
          "out-of-balance force at which an increment is accepted, over the reference force",
          {.maximum = 1, .above = 0});
}

Table make_table() {
    Table t;
    t.add("seed", "1", [](auto& p) -> auto& { return p.seed; },
          "of all random numbers; another seed is another fruit of the same kind",
          {.minimum = 0, .maximum = 9007199254740992.0});
    add_fruit(t);
    add_physics(t);
    add_moisture(t);
    add_segments(t);
    add_fibres(t);
    add_plastic(t);
    add_contact(t);
    add_numerics(t);
    t.add("output.frames", "1", [](auto& p) -> auto& { return p.output.frames; },
          "number of frames at even shrinkages or hours, the fresh fruit being the first",
          {.minimum = 2, .maximum = 10000});
    t.add("output.shrinkages", "1", [](auto& p) -> auto& { return p.output.shrinkages; },
          "shrinkages of the frames, instead of output.frames; the fresh fruit and the end are always taken",
          {.minimum = 0, .below = 1});
    t.add(
        "output.hours", "h", [](auto& p) -> auto& { return p.output.hours; },
        "hours of the frames, where moisture.hours is set, instead of output.frames; the fresh fruit and the "
        "end are always taken",
        {.minimum = 0});
    return t;
}

}  // namespace

const ParameterTable<DryingParameters>& drying_parameters() {
    static const Table kTable = make_table();
    return kTable;
}

}  // namespace windfall::drying
