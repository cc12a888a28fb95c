#pragma once
// A broken or cracked branch, start to finish: parameters in, frames out (Yang, Yang, Yang 2019).
#include <cstddef>
#include <span>

#include "core/run_context.h"
#include "fracture/parameters.h"
#include "take/frame_sink.h"

namespace windfall::fracture {

/// Breaks a branch (or cracks a log) and hands meshes, frames and summary to `sink`: one frame of the still
/// break, or those of the breaking. With `checkpoint` (of an earlier run with the same parameters; empty:
/// from the start) it goes on from there, to the same bits as a run without interruption. Throws InputError
/// for parameters that `check` refuses, Cancelled when the context says so.
void run(const FractureParameters& parameters, take::FrameSink& sink, const RunContext& context,
         std::span<const std::byte> checkpoint = {});

}  // namespace windfall::fracture
