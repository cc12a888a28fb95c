#pragma once
// A run of decay from start to end.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "decay/parameters.h"
#include "decay/rot_colours.h"
#include "decay/specimen.h"
#include "take/frame_sink.h"

namespace windfall::decay {

/// Emits meshes, frames (dressed with `look` where the parameters ask for it), a checkpoint every few seconds
/// and when it is cancelled, and a summary. With a checkpoint it goes on behind the frame that the checkpoint
/// was saved at. Throws InputError, RunError, Cancelled.
void run(const DecayParameters& parameters, const Specimen& specimen, const RotLook& look,
         take::FrameSink& sink, const RunContext& context, std::span<const std::byte> checkpoint);

/// What a run will do, and what speaks against it.
struct DecayPlan {
    double days = 0;
    std::size_t skin_vertices = 0;
    double fresh_loss_kg_day = 0;  ///< water, in the climate's first hour
    std::vector<std::string> warnings;
};
DecayPlan plan(const DecayParameters& parameters);

}  // namespace windfall::decay
