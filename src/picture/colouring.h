#pragma once
// Colours that show a quantity on the surface instead of the fruit's own material.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"
#include "take/frame.h"

namespace windfall::picture {

/// What the surface shows. Curvature: mean curvature, red convex, blue concave. Depth: red ridges, blue
/// valleys. Tissue: pith, heartwood, sapwood, phloem and bark, a colour each. Height: along the branch, from
/// dark blue to yellow. Moisture: under the skin, from none (yellow) to the fresh fruit's (dark blue).
enum class Colouring { Material, Curvature, Depth, Tissue, Height, Moisture };

/// "material", "curvature", "depth", "tissue", "height", "moisture"; InputError for any other name.
Colouring colouring_named(const std::string& name);
const std::vector<std::string>& colouring_names();

/// Mean curvature at the vertices, 1/length; positive where the surface is convex (sphere: 1/radius).
/// The gradient of the area (triangles: the cotangent formula) over the area that belongs to the vertex.
std::vector<double> mean_curvature(const std::vector<geometry::Vec3>& positions,
                                   const std::vector<geometry::Face>& faces);

/// The value which `fraction` of the magnitudes of all sets of values do not exceed (0.97: robust maximum);
/// 1 when every value is zero or there is none.
double robust_magnitude(std::span<const std::vector<double>> sets, double fraction);

/// The values that a colouring shows at the vertices of a mesh: mean curvature; the attribute "depth" with
/// its sign turned, so that ridges are positive as they are in curvature; "tissue"; "height"; "moisture".
/// Empty for the material. Throws InputError when the mesh has no such attribute.
std::vector<double> shown_values(Colouring colouring, const take::TakeMesh& mesh,
                                 const take::FrameMesh& moved);

/// The values that have the first and the last colour.
struct ColourRange {
    double low = -1, high = 1;
};

/// One range for all of these values, so that a colour means the same in all pictures of a take: symmetrical
/// about zero for curvature and depth, where a tenth of the largest is cut off.
ColourRange colour_range(Colouring colouring, std::span<const std::vector<double>> sets);

/// Linear RGB of a value.
std::array<float, 3> shown_colour(Colouring colouring, double value, const ColourRange& range);

/// Diverging map for t in [-1, 1]: blue, white at 0, red; linear RGB.
std::array<float, 3> diverging_colour(double t);

/// From dark blue to yellow for t in [0, 1], ever brighter (viridis); linear RGB.
std::array<float, 3> sequential_colour(double t);

}  // namespace windfall::picture
