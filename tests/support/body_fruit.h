#pragma once
// Fruit for the tests of the body: a tomato with five ribs, 74 x 74 x 60 mm, and an apple.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "decay/body.h"

namespace windfall::test {

/// Radius (m) of a fruit with ribs, a dent at the stem and one at the blossom, flattened along z.
inline decay::SurfaceFunction ribbed_fruit(double radius_m, double ribs, double stem_dent, double flatness) {
    return [=](const geometry::Vec3& d) -> geometry::Vec3 {
        const double polar = std::acos(std::clamp(d.z(), -1.0, 1.0));
        const double around = std::atan2(d.y(), d.x());
        double r = radius_m * (1 + ribs * std::pow(std::sin(polar), 2) * std::cos(5 * around));
        r *= 1 - stem_dent * std::exp(-std::pow(polar / 0.4, 2));
        r *= 1 - 0.05 * std::exp(-std::pow((std::numbers::pi - polar) / 0.4, 2));
        return {r * d.x(), r * d.y(), flatness * r * d.z()};
    };
}

inline decay::SurfaceFunction body_tomato() { return ribbed_fruit(0.037, 0.025, 0.22, 0.82); }
inline decay::SurfaceFunction body_apple() { return ribbed_fruit(0.038, 0.01, 0.42, 0.95); }

}  // namespace windfall::test
