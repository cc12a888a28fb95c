#pragma once
// Light transport by path tracing on Embree.
#include "core/run_context.h"
#include "picture/image.h"
#include "picture/scene.h"

namespace windfall::picture {

struct RenderSettings {
    int width = 480;
    int height = 480;
    int samples = 48;  ///< paths per pixel
    int bounces = 3;   ///< reflections on a path, at least 1
    bool denoise = true;
    std::uint64_t seed = 0;
};

/// Renders the scene in linear light. Same scene and settings, same bits, on any number of threads.
/// Progress runs from 0 to 1 and carries the seconds left; Cancelled is thrown between tiles.
/// Throws InputError for sizes or samples that cannot be, RunError when Embree fails.
Image render(const Scene& scene, const RenderSettings& settings, const RunContext& context = {});

}  // namespace windfall::picture
