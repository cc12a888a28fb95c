#include "geometry/medial_radius.h"

#include <cmath>
#include <numbers>

namespace windfall::geometry {

double medial_radius(const TriangleTree& tree, const Vec3& point, const Vec3& normal, double largest,
                     double skin) {
    constexpr int kBalls = 30;
    constexpr double kTouching =
        0.98;  // of the radius: a surface not nearer than that does not enter the ball
    const double seen_as_one = std::cos(20 * std::numbers::pi / 180);
    double radius = largest;
    for (int k = 0; k < kBalls; ++k) {
        const Vec3 centre = point - radius * normal;
        const TriangleTree::Nearest touched = tree.nearest(centre, Vec3::Zero(), kTouching * radius);
        const Vec3 chord = point - touched.point;
        if (touched.place.triangle < 0 || chord.norm() < skin) return radius;
        const double height = 2 * normal.dot(chord);
        if (!(height > 0)) return radius;
        // The ball through both places, tangent at the first.
        const double next = chord.squaredNorm() / height;
        const Vec3 to_touched = touched.point - (point - next * normal);
        if (normal.dot(to_touched) > seen_as_one * to_touched.norm()) return radius;
        if (next >= radius) return radius;
        radius = next;
    }
    return radius;
}

}  // namespace windfall::geometry
