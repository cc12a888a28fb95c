#include <fmt/format.h>

#include <set>
#include <string>

#include "decay/decay_process.h"
#include "decay/measure.h"
#include "recipe/process_entry.h"
#include "recipe/specimen_file.h"

namespace windfall::recipe {
namespace {

RunPlan plan_decay(const Recipe& recipe) {
    const decay::DecayParameters& p = recipe.decay;
    const decay::DecayPlan plan = decay::plan(p);
    RunPlan result;
    result.lines = {
        {"fruit", fmt::format("{} of {:.3g} g, {:.3g} g of it water", p.pile.count, 1000 * p.fruit.mass_kg,
                              1000 * p.fruit.water_kg)},
        {"skin", fmt::format("{} vertices, maps of {} x {} texels", plan.skin_vertices, p.output.texels,
                             p.output.texels)},
        {"water", fmt::format("loses about {:.2g} g a day while fresh", 1000 * plan.fresh_loss_kg_day)},
        {"frames", fmt::format("{}, {:.3g} days", p.output.frames, plan.days)},
    };
    result.warnings = plan.warnings;
    return result;
}

}  // namespace

Process decay_process() {
    Process process;
    process.name = "decay";
    process.command = "rot";
    process.doc = "rot a fruit: mold, soft rot, water loss, collapse";
    process.parameters = of_recipe(decay::decay_parameters(), &Recipe::decay);
    process.look = rot_look_of_recipe();
    // Colours come with the maps; of a picture's own look only this shows on a rotting fruit.
    const std::set<std::string> shown{"look.gloss", "look.softness",  "look.softness_colour",
                                      "look.pores", "look.pore_size", "look.pose"};
    for (Parameter<Recipe>& parameter : look_of_recipe())
        if (shown.contains(parameter.info.key)) process.look.push_back(std::move(parameter));
    process.measure_columns = {
        {"frame", "frame", 0},
        {"day", "day", 2},
        {"water_lost_g", "water lost/g", 2},
        {"rot_percent", "rot/%", 1},
        {"mold_percent", "mold/%", 1},
        {"mold_speed_mm_day", "mold mm/day", 2},
        {"colonies", "colonies", 0},
        {"volume_ratio", "volume", 4},
        {"height_mm", "height/mm", 1},
    };
    process.check = [](const Recipe& recipe) {
        decay::check(recipe.decay);
        // Files that cannot be read are told of before a take is begun.
        decay::check_wounds(recipe.decay, read_specimen(recipe.decay).surface);
    };
    process.unit_length_m = [](const Recipe&) { return 1.0; };
    process.plan = plan_decay;
    process.run = [](const Recipe& recipe, take::FrameSink& sink, const RunContext& context,
                     std::span<const std::byte> checkpoint) {
        decay::RotLook look = recipe.rot_look;
        if (look.species.empty()) {
            const auto fungi = decay::fungus_names(recipe.decay.growth);
            look.species = fungi.empty() ? "none" : fungi.front();
        }
        decay::run(recipe.decay, read_specimen(recipe.decay), look, sink, context, checkpoint);
    };
    process.measure = decay::measure;
    return process;
}

}  // namespace windfall::recipe
