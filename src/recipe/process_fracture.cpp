#include <fmt/format.h>

#include "fracture/broken_branch.h"
#include "fracture/fracture_process.h"
#include "fracture/measure.h"
#include "fracture/plan.h"
#include "recipe/process_entry.h"

namespace windfall::recipe {
namespace {

RunPlan plan_fracture(const Recipe& recipe) {
    const fracture::FractureParameters& p = recipe.fracture;
    const fracture::Plan plan = fracture::plan(p);
    RunPlan result;
    result.lines = {{"lattice", fmt::format("{} rings x {} sectors x {} layers", p.branch.rings,
                                            p.branch.sectors, p.branch.layers)},
                    {"vertices", fmt::format("about {}", plan.vertices)}};
    const bool is_broken = p.fracture.end == fracture::EndKind::Broken;
    if (is_broken && p.fracture.height_from == fracture::HeightSource::Species)
        result.lines.emplace_back(
            "height", fmt::format("mean {:.4g} radii, by the law of the species", *plan.law_height));
    else if (is_broken && p.fracture.height_from == fracture::HeightSource::Asked)
        result.lines.emplace_back("height",
                                  fmt::format("mean {:.4g} radii, as asked", p.fracture.mean_height));
    else if (is_broken)
        result.lines.emplace_back(
            "height", fmt::format("as the amplitudes make it (by the law of the species: mean {:.4g} radii)",
                                  *plan.law_height));
    result.lines.emplace_back("frames", fmt::format("{}", plan.frames));
    result.warnings = plan.warnings;
    return result;
}

}  // namespace

Process fracture_process() {
    Process process;
    process.name = "fracture";
    process.command = "snap";
    process.doc = "break a branch, or crack a sawn log";
    process.parameters = of_recipe(fracture::fracture_parameters(), &Recipe::fracture);
    process.measure_columns = {
        {"frame", "frame", 0},
        {"time", "time", 3},
        {"stub_volume", "stub volume", 4},
        {"piece_volume", "piece volume", 4},
        {"bonds_holding", "bonds", 3},
        {"fibres_bridging", "fibres", 3},
        {"bend_deg", "bend", 1},
    };
    process.check = [](const Recipe& recipe) {
        fracture::check(recipe.fracture);
        fracture::check_surface(recipe.fracture);  // before a take is begun
    };
    process.unit_length_m = [](const Recipe& recipe) { return recipe.fracture.branch.diameter_m / 2; };
    process.plan = plan_fracture;
    process.run = [](const Recipe& recipe, take::FrameSink& sink, const RunContext& context,
                     std::span<const std::byte> checkpoint) {
        fracture::run(recipe.fracture, sink, context, checkpoint);
    };
    process.measure = fracture::measure;
    return process;
}

}  // namespace windfall::recipe
