#include <fmt/format.h>

#include <memory>

#include "drying/drying_process.h"
#include "drying/measure.h"
#include "recipe/fruit_file.h"
#include "recipe/painted_mask.h"
#include "recipe/process_entry.h"

namespace windfall::recipe {
namespace {

RunPlan plan_drying(const Recipe& recipe) {
    const auto fruit = read_fruit(recipe.drying);
    const drying::Plan plan = fruit ? drying::plan(recipe.drying, *fruit) : drying::plan(recipe.drying);
    const double te = recipe.drying.fruit.skin_thickness;
    return {
        {{"mesh", fmt::format("{} x {} x {} brick, {} layers", plan.n, plan.n_axial, plan.n, plan.layers)},
         {"unknowns", fmt::format("{}", plan.unknowns)},
         {"wave length",
          fmt::format("about {:.3g} r_1, {:.3g} t_e; {:.3g} elements a wave", plan.expected_wave_length,
                      plan.expected_wave_length / te, plan.elements_per_wave)},
         {"frames", fmt::format("{}", drying::frame_parameters(recipe.drying).size())}},
        plan.warnings};
}

drying::SkinPaint paint_of(const Recipe& recipe) {
    const drying::MoistureParameters& moisture = recipe.drying.moisture;
    if (!moisture.on() || moisture.map.empty()) return {};
    const auto mask = std::make_shared<const PaintedMask>("moisture.map", moisture.map);
    return [mask](const geometry::Vec2& uv) { return static_cast<double>(mask->at(uv)); };
}

}  // namespace

Process drying_process() {
    Process process;
    process.name = "drying";
    process.command = "dry";
    process.doc = "dry a fruit until its skin wrinkles";
    process.parameters = of_recipe(drying::drying_parameters(), &Recipe::drying);
    process.look = look_of_recipe();
    process.measure_columns = {
        {"frame", "frame", 0},
        {"time", "time", 3},
        {"hours", "hours", 1},
        {"water_lost_percent", "water lost/%", 2},
        {"shrinkage", "shrinkage", 4},
        {"flesh_volume_ratio", "flesh volume", 4},
        {"total_volume_ratio", "total volume", 4},
        {"depth_rms_over_te", "depth/t_e", 3},
        {"wavelength_over_te", "wave/t_e", 2},
        {"valleys", "valleys", 0},
        {"ridge_meridian_alignment", "alignment", 3},
    };
    process.check = [](const Recipe& recipe) {
        drying::check(recipe.drying);
        // Files that cannot be read are told of before a take is begun.
        paint_of(recipe);
        read_meshes(recipe.drying);
    };
    process.unit_length_m = [](const Recipe& recipe) { return real_r1_m(recipe.drying); };
    process.plan = plan_drying;
    process.run = [](const Recipe& recipe, take::FrameSink& sink, const RunContext& context,
                     std::span<const std::byte> checkpoint) {
        drying::run(recipe.drying, {read_fruit(recipe.drying), paint_of(recipe)}, sink, context, checkpoint);
    };
    process.measure = drying::measure;
    return process;
}

}  // namespace windfall::recipe
