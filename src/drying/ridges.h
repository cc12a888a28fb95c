#pragma once
// What wrinkles look like in numbers, from the depth of each vertex of the skin (docs/measures.md).
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::drying {

inline constexpr int kLatitudeBands = 12;  ///< of 15 degrees each, from the south pole

struct RidgeMeasures {
    double depth_rms = 0;   ///< root mean square depth, area-weighted, about its mean
    double wavelength = 0;  ///< 2 pi over the root mean square wave number, fresh lengths
    int valleys = 0;
    double meridian_alignment = 0;  ///< -1: ridges run across the meridians, 1: along them
    std::vector<double> depth_rms_by_latitude;
};

/// `rest`: fresh positions of the closed surface; `depth`: below the smooth surface, positive in valleys. The
/// axis is y. Everything is measured on the fresh surface.
RidgeMeasures measure_ridges(const std::vector<geometry::Vec3>& rest,
                             const std::vector<geometry::Face>& faces, const std::vector<double>& depth);

/// Number of connected regions deeper than half the root mean square depth that reach below one root mean
/// square.
int count_valleys(const std::vector<geometry::Face>& faces, const std::vector<double>& depth,
                  double depth_rms);

}  // namespace windfall::drying
