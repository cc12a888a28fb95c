#pragma once
// Frames of a drying run: the skin's surface with its attributes, and the numbers of the whole fruit.
#include "drying/drying_path.h"
#include "take/frame.h"

namespace windfall::drying {

/// Name of the only mesh of a drying take: the outer surface of the skin.
inline constexpr const char* kSkinMesh = "skin";

/// The fresh skin with texture coordinates.
take::TakeMesh skin_mesh(const geometry::LayeredMesh& mesh);

/// The frame of the path's present state. Attributes on the skin's vertices: `depth` below the smooth surface
/// (r_1), `stretch` (square root of the area over the fresh area), `J` (elastic volume ratio, mean of the
/// adjacent elements) and `pressure` (likewise, in C0 of the flesh); by the hour also `moisture` (water under
/// the skin over the fresh flesh's) and `dryness` (shrinkage there over the largest). Scalars: see
/// docs/measures.md.
take::Frame make_frame(const DryingPath& path, const DryingParameters& parameters, int index);

}  // namespace windfall::drying
