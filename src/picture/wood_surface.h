#pragma once
// Bark and broken wood as surfaces of the scene.
#include <span>
#include <string>
#include <vector>

#include "picture/colouring.h"
#include "picture/scene.h"
#include "take/frame.h"

namespace windfall::picture {

/// How a material of a take reflects: known by its name ("bark", "end_grain", "fibres", "thorns",
/// "inner_bark", "crack"); any other one is plain and dull.
Finish wood_finish(const take::Material& material);

/// A mesh with materials, as it is in a frame: not refined, since torn fibres are sharp; with the colours of
/// its attribute "colour" (of each material its own where there is none), and its rest shape for the grain.
/// Throws InputError when the frame's vertices are not those of the mesh or are no numbers.
SceneMesh wood_mesh(const take::TakeMesh& mesh, const take::FrameMesh& moved);

/// The same mesh with the colours of values, without any grain.
SceneMesh wood_diagram(const take::TakeMesh& mesh, const take::FrameMesh& moved, Colouring colouring,
                       const ColourRange& range);

/// What a picture of a branch may show.
enum class View {
    Whole,  ///< all of it
    Break,  ///< the broken end, or the cracked one, and some of the bark below
};

/// The region of a view, over several frames of a take.
Region wood_region(View view, const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> frames);

}  // namespace windfall::picture
