#pragma once
// Whether a mesh's texture coordinates can carry maps: there, inside the square, and no two places of the
// surface on one texel.
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

enum class UvDefectKind {
    Missing,     ///< no texture coordinates, or some that are not numbers
    OutOfRange,  ///< outside [0, 1]: tiles (UDIM) and repeats carry no single map
    NoArea,      ///< more than a hundredth of the surface on points or lines, as palettes have it
    Overlap,     ///< charts that lie on each other
};

struct UvDefect {
    UvDefectKind kind = UvDefectKind::Missing;
    Vec2 place = Vec2::Zero();        ///< in texture coordinates; the value itself when out of range
    std::vector<std::int32_t> faces;  ///< of the mesh, ascending
    std::string text;                 ///< what, where and the remedy
};

/// Everything that is wrong, kinds in the order above; one defect for each kind but overlaps, of which there
/// is one a connected patch. Overlaps are looked for on a raster of 512 x 512; patches of kSmallestOverlap
/// texels and fewer count as rounding. Faces that share a vertex are never an overlap. Where
/// the faces would cover the square four times and more that is the one overlap, without place and faces.
std::vector<UvDefect> uv_defects(const SurfaceMesh& mesh);
inline constexpr int kSmallestOverlap = 4;

/// Throws InputError naming the first few defects, if there are any; `name` is the file's.
void require_uvs(const SurfaceMesh& mesh, const std::string& name);

}  // namespace windfall::geometry
