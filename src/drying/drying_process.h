#pragma once
// Drying of a core/shell fruit, start to finish: parameters in, frames out (Liu et al. 2015).
#include <cstddef>
#include <memory>
#include <span>

#include "core/run_context.h"
#include "drying/artist_fruit.h"
#include "drying/parameters.h"
#include "drying/skin_exposure.h"
#include "take/frame_sink.h"

namespace windfall::drying {

/// What the files that a recipe names hold.
struct FruitFiles {
    std::unique_ptr<const ArtistFruit> fruit;  ///< of fruit.mesh; null: the ten numbers
    SkinPaint paint;                           ///< of moisture.map
};

/// Dries a fruit and hands every frame, checkpoint and summary to `sink`. With `checkpoint` (of an earlier
/// run with the same parameters; empty: from the start) it goes on from there, to the same bits as a run
/// without interruption. Throws InputError for parameters that cannot be meshed, RunError where equilibrium
/// is lost (the frames so far have been emitted), Cancelled when the context says so, after a last
/// checkpoint. Files that the parameters name are not read.
void run(const DryingParameters& parameters, take::FrameSink& sink, const RunContext& context,
         std::span<const std::byte> checkpoint = {});
/// The same with what files hold.
void run(const DryingParameters& parameters, const FruitFiles& files, take::FrameSink& sink,
         const RunContext& context, std::span<const std::byte> checkpoint = {});

/// What `run` will solve, for people and for warnings before a long run.
struct Plan {
    std::int64_t n = 0;        ///< elements along the short sides of the brick
    std::int64_t n_axial = 0;  ///< elements along the fruit's axis
    int layers = 0;
    std::int64_t unknowns = 0;
    double expected_wave_length = 0;  ///< in r_1
    double elements_per_wave = 0;
    std::vector<std::string> warnings;  ///< each with the number to set
};
Plan plan(const DryingParameters& parameters);
Plan plan(const DryingParameters& parameters, const ArtistFruit& fruit);

}  // namespace windfall::drying
