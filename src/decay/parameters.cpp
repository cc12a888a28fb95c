#include "decay/parameters.h"

#include "core/parameter_group.h"

namespace windfall::decay {
namespace {

using Table = ParameterTable<DecayParameters>;

constexpr ParameterRange kFraction = {.minimum = 0, .maximum = 1};
constexpr ParameterRange kPercent = {.minimum = 0, .maximum = 100};

void add_fruit(Table& table) {
    using P = FruitParameters;
    ParameterGroup t(table, "fruit", &DecayParameters::fruit);
    t.add_choice("kind", &P::kind, {"tomato", "apple", "orange", "peach", "pear", "ball", "mesh"},
                 "shape of the fruit; mesh: that of fruit.mesh");
    t.add("mesh", "file", &P::mesh,
          "file of a closed mesh with texture coordinates (.obj, .ply, .gltf, .glb), for kind mesh; its "
          "vertices keep their order. Scaled to the mass");
    t.add_choice("up", &P::up, {"y", "z"}, "which of the mesh's axes points up");
    t.add_choice(
        "uvs", &P::uvs, {"own", "atlas"},
        "own: the take has the mesh's vertices and texture coordinates; atlas: Windfall's own skin in that "
        "shape, for meshes whose texture coordinates are missing or overlap");
    t.add("mass_kg", "kg", &P::mass_kg, "mass of the fresh fruit, which is as dense as water",
          {.minimum = 0.001, .maximum = 20});
    t.add("water_kg", "kg", &P::water_kg, "the part of it that is water; less than the mass",
          {.maximum = 20, .above = 0});
    t.add("firmness", "1", &P::firmness,
          "of the fresh flesh: 2 kPa at 0, 4 MPa at 100; a soft fruit sags under its own weight",
          {.minimum = 1, .maximum = 100});
    t.add("thickness", "1", &P::thickness,
          "of the skin: 0.05 mm at 0, 3 mm at 100; thick skins wrinkle widely",
          {.minimum = 1, .maximum = 100});
    t.add("porosity", "1", &P::porosity, "how easily rot and mold spread in it (s of eq. 4)", kPercent);
}

void add_water(Table& table) {
    using P = WaterParameters;
    ParameterGroup t(table, "water", &DecayParameters::water);
    t.add("transpiration_ug_s_m2_pa", "ug/(s m2 Pa)", &P::transpiration_ug_s_m2_pa,
          "K of eq. 10: water that leaves through the skin", {.minimum = 0, .maximum = 200});
    t.add("rot_leak", "1", &P::rot_leak, "how many times as fast where the skin is rotten",
          {.minimum = 1, .maximum = 20});
}

void add_growth(Table& table) {
    using P = GrowthParameters;
    ParameterGroup t(table, "growth", &DecayParameters::growth);
    t.add("soft_rot", "", &P::soft_rot, "species that rots the skin ahead of the mold");
    t.add("fungi", "", &P::fungi,
          "species of mold, with commas between: penicillium-digitatum, penicillium-expansum, rhizopus, "
          "neofabraea, botrytis; empty: none");
    t.add_choice("form", &P::form, {"kawasaki", "logistic"}, "how motility depends on density");
    t.add("growth", "1", &P::growth,
          "how fast all of them grow; 50: two to three millimetres a day at their best",
          {.minimum = 0, .maximum = 100});
    t.add("propagation", "1", &P::propagation,
          "how many colonies spring from others: one seed a day with probability 1 / (10 - this)",
          {.minimum = 0, .maximum = 9});
    t.add("reach_m", "m", &P::reach_m, "how far those seeds fall", {.maximum = 0.2, .above = 0});
    t.add("nutrient", "1", &P::nutrient, "mean nutrient at the start; below 0.25 nothing spreads",
          {.maximum = 2, .above = 0});
    t.add("nutrient_noise", "1", &P::nutrient_noise, "unevenness of the nutrient", kFraction);
    t.add("nutrient_noise_m", "m", &P::nutrient_noise_m, "length of that unevenness",
          {.maximum = 0.1, .above = 0});
    t.add("edge_noise", "1", &P::edge_noise, "unevenness of the motility; 0: smooth fronts", kFraction);
    t.add("edge_noise_m", "m", &P::edge_noise_m, "length of that unevenness", {.maximum = 0.1, .above = 0});
    t.add("step_noise", "1", &P::step_noise, "range of delta (eq. 5), drawn anew in every step", kFraction);
}

void add_start(Table& table) {
    using P = StartParameters;
    ParameterGroup t(table, "start", &DecayParameters::start);
    t.add("random", "1", &P::random, "wounds at places drawn from the seed", {.minimum = 0, .maximum = 100});
    t.add("contacts", "", &P::contacts,
          "whether rot begins where the fruit touches table, bowl or neighbour");
    t.add("stem", "", &P::stem, "whether rot begins at the stem scar");
    t.add("wounds_m", "m", &P::wounds_m,
          "x, y, z of each wound, on or near the fresh fruit, which stands on y = 0 about the y axis");
    t.add("mask", "file", &P::mask,
          "square PNG over the fruit's texture coordinates whose bright texels are wounded");
    t.add("mask_wounds", "1", &P::mask_wounds, "wounds drawn from the mask", {.minimum = 1, .maximum = 500});
    t.add("radius_m", "m", &P::radius_m, "of a wound", {.maximum = 0.05, .above = 0});
}

void add_body(Table& table) {
    using P = BodyParameters;
    ParameterGroup t(table, "body", &DecayParameters::body);
    t.add("shrinking", "1", &P::shrinking, "share of the lost water's volume by which the flesh shrinks",
          kFraction);
    t.add("softening", "1", &P::softening, "modulus of the flesh, in the end, over that of the fresh flesh",
          {.minimum = 0.001, .maximum = 1});
    t.add("softening_days", "d", &P::softening_days, "until it is as soft as that",
          {.maximum = 1000, .above = 0});
    t.add("rot_shrinkage", "1", &P::rot_shrinkage, "share of its length that thoroughly rotten flesh loses",
          {.minimum = 0, .maximum = 0.6});
    t.add("rot_softening", "1", &P::rot_softening, "how many times as soft thoroughly rotten flesh is",
          {.minimum = 1, .maximum = 1000});
    t.add("rot_depth_m", "m", &P::rot_depth_m, "depth at which rot's effect has fallen to 1/e",
          {.minimum = 0.001, .maximum = 0.1});
    t.add("skin_modulus_pa", "Pa", &P::skin_modulus_pa, "Young's modulus of the skin",
          {.minimum = 1e5, .maximum = 1e9});
    t.add("wrinkle_m", "m", &P::wrinkle_m, "wave length of the wrinkles; 0: from thickness and moduli",
          {.minimum = 0, .maximum = 0.1});
    t.add("skin_cells", "1", &P::skin_cells, "skin quads along the edge of a cube: 6 n^2 + 2 vertices",
          {.minimum = 8, .maximum = 200});
    t.add("flesh_cells", "1", &P::flesh_cells, "the same of the flesh; finer moves nothing visibly",
          {.minimum = 4, .maximum = 24});
}

void add_pile(Table& table) {
    using P = PileParameters;
    ParameterGroup t(table, "pile", &DecayParameters::pile);
    t.add("count", "1", &P::count, "fruit; more than one are dropped, settle, touch and infect each other",
          {.minimum = 1, .maximum = 30});
    t.add_choice("ground", &P::ground, {"table", "bowl"}, "what a pile lies on");
    t.add("bowl_radius_m", "m", &P::bowl_radius_m, "of the sphere that the bowl is a part of",
          {.minimum = 0.02, .maximum = 1});
    t.add("bowl_height_m", "m", &P::bowl_height_m, "of its rim", {.minimum = 0.01, .maximum = 1});
    t.add("variation", "1", &P::variation, "of the fruits' sizes, drawn from the seed",
          {.minimum = 0, .maximum = 0.3});
}

void add_output(Table& table) {
    using P = OutputParameters;
    ParameterGroup t(table, "output", &DecayParameters::output);
    t.add("frames", "1", &P::frames, "frames, the fresh fruit the first of them",
          {.minimum = 1, .maximum = 100000});
    t.add("hours_per_frame", "h", &P::hours_per_frame, "time between frames",
          {.minimum = 0.05, .maximum = 48});
    t.add("texels", "1", &P::texels, "side of the square maps; even", {.minimum = 64, .maximum = 4096});
    t.add("flesh", "", &P::flesh, "whether frames hold the flesh's surface besides the skin");
    t.add("shading_maps", "", &P::shading_maps,
          "whether frames hold shading maps; if not, show and export make them");
    t.add("hair", "1", &P::hair, "strands of mold in the frames; 0: show and export make them",
          {.minimum = 0, .maximum = 200000});
}

Table make_table() {
    Table table;
    table.add("seed", "1", [](auto& p) -> auto& { return p.seed; },
              "of all random numbers; another seed is another fruit of the same kind", {.minimum = 0});
    add_fruit(table);
    water::add_climate(table, &DecayParameters::climate);
    add_water(table);
    add_growth(table);
    add_start(table);
    add_body(table);
    add_pile(table);
    add_output(table);
    return table;
}

}  // namespace

const ParameterTable<DecayParameters>& decay_parameters() {
    static const Table kTable = make_table();
    return kTable;
}

}  // namespace windfall::decay
