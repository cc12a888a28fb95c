#pragma once
// Colours that show a quantity on the surface instead of the fruit's own material.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::picture {

/// What the surface shows. Curvature: mean curvature, red convex, blue concave. Depth: red ridges, blue
/// valleys.
enum class Colouring { Material, Curvature, Depth };

/// "material", "curvature", "depth"; InputError for any other name.
Colouring colouring_named(const std::string& name);
const std::vector<std::string>& colouring_names();

/// Mean curvature at the vertices, 1/length; positive where the surface is convex (sphere: 1/radius).
/// The gradient of the area (triangles: the cotangent formula) over the area that belongs to the vertex.
std::vector<double> mean_curvature(const std::vector<geometry::Vec3>& positions,
                                   const std::vector<geometry::Face>& faces);

/// The value which `fraction` of the magnitudes of all sets of values do not exceed (0.97: robust maximum);
/// 1 when every value is zero or there is none.
double robust_magnitude(std::span<const std::vector<double>> sets, double fraction);

/// Diverging map for t in [-1, 1]: blue, white at 0, red; linear RGB.
std::array<float, 3> diverging_colour(double t);

}  // namespace windfall::picture
