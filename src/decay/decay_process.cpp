#include "decay/decay_process.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "decay/dressing.h"
#include "decay/organisms_of.h"
#include "decay/rotting_pile.h"
#include "water/transpiration.h"

namespace windfall::decay {
namespace {

// A checkpoint is as large as twenty frames: it is not saved with every one.
constexpr double kCheckpointSeconds = 5;

/// Keeps the meshes that pass, which the dressing of frames needs.
class MeshKeeper final : public take::FrameSink {
  public:
    void add_mesh(const take::TakeMesh& mesh) override { meshes.push_back(mesh); }
    void add_frame(const take::Frame& /*frame*/) override {}
    void save_checkpoint(std::span<const std::byte> /*bytes*/) override {}
    void set_summary(const nlohmann::json& /*summary*/) override {}
    std::vector<take::TakeMesh> meshes;
};

std::unique_ptr<Dressing> dressing_for(const DecayParameters& parameters,
                                       const std::vector<take::TakeMesh>& meshes, const RotLook& look) {
    if (!parameters.output.shading_maps && parameters.output.hair == 0) return nullptr;
    DressingSettings settings;
    settings.look = look;
    settings.strands = static_cast<int>(parameters.output.hair);
    settings.shading_maps = parameters.output.shading_maps;
    settings.seed = parameters.seed;
    return std::make_unique<Dressing>(meshes, 1.0, settings);
}

std::string detail_of(const take::Frame& frame) {
    const auto& s = frame.scalars;
    return fmt::format("day {:.1f}, water lost {:.1f} g, rot {:.0f} %, mold {:.0f} %", frame.time / 24,
                       1000 * s.at("water_lost_kg"), 100 * s.at("rot_m2") / s.at("skin_m2"),
                       100 * s.at("mold_m2") / s.at("skin_m2"));
}

}  // namespace

DecayPlan plan(const DecayParameters& parameters) {
    DecayPlan plan;
    plan.days = static_cast<double>(parameters.output.frames - 1) * parameters.output.hours_per_frame / 24;
    const auto n = static_cast<std::size_t>(parameters.body.skin_cells);
    plan.skin_vertices = (6 * n * n + 2) * static_cast<std::size_t>(parameters.pile.count);
    const water::Air air = water::climate_of(parameters.climate).at(0);
    const double loss_kg_s = water::transpiration_kg_per_s(
        {parameters.water.transpiration_ug_s_m2_pa, water::ball_area_m2(parameters.fruit.mass_kg),
         air.temperature_c, air.temperature_c, air.relative_humidity});
    plan.fresh_loss_kg_day = 86400 * loss_kg_s;
    if (plan.fresh_loss_kg_day * plan.days > parameters.fruit.water_kg)
        plan.warnings.push_back(
            fmt::format("in this climate its water is gone after about {:.0f} of {:.0f} days; a lower "
                        "water.transpiration_ug_s_m2_pa or a damper climate keeps it longer",
                        parameters.fruit.water_kg / plan.fresh_loss_kg_day, plan.days));
    for (const Organism& organism : organisms_of(parameters))
        if (cardinal_growth(organism.species.temperature_c, air.temperature_c) == 0)
            plan.warnings.push_back(fmt::format("at {:g} C {} does not grow: it does between {:g} and {:g} C",
                                                air.temperature_c, organism.species.name,
                                                organism.species.temperature_c.minimum,
                                                organism.species.temperature_c.maximum));
    return plan;
}

void run(const DecayParameters& parameters, const Specimen& specimen, const RotLook& look,
         take::FrameSink& sink, const RunContext& context, std::span<const std::byte> checkpoint) {
    check(parameters);
    context.progress({"settling", 0, 1, -1, ""});
    const auto begin = std::chrono::steady_clock::now();
    RottingPile pile(parameters, specimen, context);
    MeshKeeper keeper;
    pile.add_meshes(keeper);
    const std::unique_ptr<Dressing> dressing = dressing_for(parameters, keeper.meshes, look);
    const auto emit = [&] {
        take::Frame frame = pile.frame();
        if (dressing) dressing->dress(frame);
        sink.add_frame(frame);
        return detail_of(frame);
    };
    if (checkpoint.empty()) {
        for (const take::TakeMesh& mesh : keeper.meshes) sink.add_mesh(mesh);
        emit();
        sink.save_checkpoint(pile.save());
    } else {
        pile.restore(checkpoint);
    }
    const auto start = std::chrono::steady_clock::now();
    auto saved = start;
    const int first = pile.frame_index(), last = static_cast<int>(parameters.output.frames) - 1;
    const auto seconds_since = [](auto moment) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - moment).count();
    };
    while (pile.frame_index() < last) {
        if (context.cancelled()) {
            sink.save_checkpoint(pile.save());
            throw Cancelled();
        }
        pile.advance();
        const std::string detail = emit();
        if (seconds_since(saved) > kCheckpointSeconds || pile.frame_index() == last) {
            sink.save_checkpoint(pile.save());
            saved = std::chrono::steady_clock::now();
        }
        const int done = pile.frame_index() - first;
        context.progress({"rotting", static_cast<double>(pile.frame_index()), static_cast<double>(last),
                          seconds_since(start) / done * (last - pile.frame_index()), detail});
    }
    sink.set_summary({{"elapsed_s", seconds_since(begin)}, {"frames", last + 1}});
}

}  // namespace windfall::decay
