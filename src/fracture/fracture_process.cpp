#include "fracture/fracture_process.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "fracture/branch_take.h"
#include "fracture/breaking_motion.h"
#include "fracture/broken_branch.h"
#include "fracture/placing.h"
#include "fracture/species.h"
#include "fracture/wood_colour.h"

namespace windfall::fracture {
namespace {

nlohmann::json summary_of(const FractureParameters& parameters, const BreakEnds& ends,
                          const CrackCount& cracks) {
    nlohmann::json summary{{"mean_height", ends.mean_height},
                           {"lowest", ends.lowest},
                           {"highest", ends.highest},
                           {"stub_thorns", ends.stub_thorns},
                           {"piece_thorns", ends.piece_thorns},
                           {"cracks",
                            {{"asked", cracks.asked},
                             {"opened", cracks.opened},
                             {"shortened", cracks.shortened},
                             {"dropped", cracks.dropped},
                             {"narrowed", cracks.narrowed}}}};
    std::vector<std::string> warnings;
    if (parameters.fracture.end == EndKind::Broken &&
        parameters.fracture.height_from == HeightSource::Species)
        asked_mean_height(parameters, &warnings);
    summary["warnings"] = warnings;
    return summary;
}

/// Meshes and frames on their way to a sink.
class Emitter {
  public:
    explicit Emitter(take::FrameSink& sink) : m_sink(sink) {}
    void mesh(const std::string& name, const BranchMesh& mesh, const std::vector<Vector3f>& colours) {
        if (!mesh.positions.empty()) m_sink.add_mesh(take_mesh(name, mesh, colours));
    }
    void positions(take::Frame& frame, const std::string& name, const std::vector<Vector3f>& places) {
        if (!places.empty()) frame.meshes.push_back(frame_mesh(name, places));
    }

  private:
    take::FrameSink& m_sink;
};

void emit_still(const FractureParameters& parameters, take::FrameSink& sink, const RunContext& context) {
    context.progress({"breaking the branch", 0, 1, -1, ""});
    const BrokenBranch branch = broken_branch(parameters);
    context.throw_if_cancelled();
    Emitter emitter(sink);
    emitter.mesh("stub", branch.ends.stub, branch.stub_colours);
    emitter.mesh("piece", branch.ends.piece, branch.piece_colours);
    take::Frame frame;
    emitter.positions(frame, "stub", branch.ends.stub.positions);
    emitter.positions(frame, "piece", branch.ends.piece.positions);
    sink.add_frame(frame);
    sink.set_summary(summary_of(parameters, branch.ends, branch.cracks));
    context.progress({"breaking the branch", 1, 1, 0, ""});
}

take::Frame frame_of(const BranchBreaking& breaking, take::FrameSink& sink) {
    const BreakingFrame moment = breaking.frame();
    take::Frame frame;
    frame.index = breaking.frame_index();
    frame.time = moment.time;
    frame.scalars = {{"bonds_holding", moment.bonds_holding},
                     {"fibres_bridging", moment.fibres_bridging},
                     {"bend_deg", moment.bend_deg}};
    Emitter emitter(sink);
    emitter.positions(frame, "stub", moment.stub);
    emitter.positions(frame, "piece", moment.piece);
    emitter.positions(frame, "fibres", moment.fibres);
    return frame;
}

/// The breaking, a frame at a time; a checkpoint with each, since a frame costs far more than its state.
void emit_breaking(const FractureParameters& parameters, take::FrameSink& sink, const RunContext& context,
                   std::span<const std::byte> checkpoint) {
    const FractureParameters p = resolved(parameters);
    BreakEnds ends;
    BreakWorkspace workspace;
    const CrackCount cracks = make_unplaced(p, ends, workspace);
    const LimbShape limb(p, ends.lowest, ends.highest);
    BranchBreaking breaking(p, ends, [&limb](std::span<Vector3f> points) { limb.apply(points); });
    if (checkpoint.empty()) {
        const std::vector<Vector3f> stub_colours = vertex_colours(ends.stub, p);
        const std::vector<Vector3f> piece_colours = vertex_colours(ends.piece, p);
        const std::vector<Vector3f> fibre_colours = vertex_colours(breaking.fibres(), p);
        limb.apply(ends);
        compute_normals(ends.stub);
        compute_normals(ends.piece);
        Emitter emitter(sink);
        emitter.mesh("stub", ends.stub, stub_colours);
        emitter.mesh("piece", ends.piece, piece_colours);
        emitter.mesh("fibres", breaking.fibres(), fibre_colours);
        sink.add_frame(frame_of(breaking, sink));
        sink.save_checkpoint(breaking.save());
    } else {
        breaking.restore(checkpoint);
    }
    const auto start = std::chrono::steady_clock::now();
    const int first = breaking.frame_index(), last = breaking.frame_count() - 1;
    while (breaking.frame_index() < last) {
        breaking.advance_to(breaking.frame_index() + 1, context);
        sink.add_frame(frame_of(breaking, sink));
        sink.save_checkpoint(breaking.save());
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        const int done = breaking.frame_index() - first;
        context.progress({"breaking", static_cast<double>(breaking.frame_index()), static_cast<double>(last),
                          spent.count() / done * (last - breaking.frame_index()),
                          fmt::format("frame {} of {}", breaking.frame_index(), last)});
    }
    sink.set_summary(summary_of(parameters, ends, cracks));
}

}  // namespace

void run(const FractureParameters& parameters, take::FrameSink& sink, const RunContext& context,
         std::span<const std::byte> checkpoint) {
    check(parameters);
    if (parameters.output.motion == Motion::Breaking && parameters.fracture.end == EndKind::Broken)
        emit_breaking(parameters, sink, context, checkpoint);
    else
        emit_still(parameters, sink, context);
}

}  // namespace windfall::fracture
