#include "drying/contact_gap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/triangle_tree.h"

namespace windfall::drying {

using geometry::Vec3;

namespace {

/// Places of the nearest points on two segments, as parts of their lengths (Ericson 2005, Real-Time Collision
/// Detection, 5.1.9).
std::array<double, 2> nearest_on_segments(const FourPoints& p) {
    const Vec3 first = p[1] - p[0], second = p[3] - p[2], between = p[0] - p[2];
    const double a = first.squaredNorm(), e = second.squaredNorm(), f = second.dot(between);
    const double b = first.dot(second), c = first.dot(between);
    const double determinant = a * e - b * b;
    double s = determinant > 0 ? std::clamp((b * f - c * e) / determinant, 0.0, 1.0) : 0.0;
    double t = (b * s + f) / e;
    if (t < 0) {
        t = 0;
        s = std::clamp(-c / a, 0.0, 1.0);
    } else if (t > 1) {
        t = 1;
        s = std::clamp((b - c) / a, 0.0, 1.0);
    }
    return {s, t};
}

}  // namespace

ContactGap contact_gap(ContactKind kind, const FourPoints& p) {
    ContactGap gap;
    if (kind == ContactKind::VertexTriangle) {
        const Vec3 w = geometry::nearest_weights(p[0], {p[1], p[2], p[3]});
        gap.weights = {1, -w[0], -w[1], -w[2]};
    } else {
        const auto [s, t] = nearest_on_segments(p);
        gap.weights = {1 - s, s, t - 1, -t};
    }
    Vec3 way = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) way += gap.weights[i] * p[i];
    gap.distance = way.norm();
    if (gap.distance > 0) gap.normal = way / gap.distance;
    return gap;
}

Mollifier edge_mollifier(const FourPoints& p, double fresh_squares) {
    constexpr double kParallel = 1e-3;
    const double threshold = kParallel * fresh_squares;
    const Vec3 a = p[1] - p[0], b = p[3] - p[2];
    const double cross = a.cross(b).squaredNorm();
    Mollifier result;
    if (cross >= threshold) return result;
    const double x = cross / threshold;
    const double slope = 2 * (1 - x) / threshold;
    const Vec3 of_a = 2 * slope * (b.squaredNorm() * a - a.dot(b) * b);
    const Vec3 of_b = 2 * slope * (a.squaredNorm() * b - a.dot(b) * a);
    result.value = x * (2 - x);
    result.gradient = {-of_a, of_a, -of_b, of_b};
    return result;
}

double free_part_of_way(ContactKind kind, const FourPoints& points, const FourPoints& motion, double gap) {
    constexpr double kKept = 0.1;      // of the distance at the start or the gap
    constexpr double kAdvance = 0.9;   // of what a look at the distance allows
    constexpr int kMostAdvances = 64;  // each stops short of the touch, so that ending early is safe
    const Vec3 mean = (motion[0] + motion[1] + motion[2] + motion[3]) / 4;
    FourPoints p = points;
    std::array<double, 4> speed{};
    FourPoints own;
    for (std::size_t i = 0; i < 4; ++i) {
        own[i] = motion[i] - mean;
        speed[i] = own[i].norm();
    }
    // The fastest approach: that of a vertex and a triangle's corner, or of two edges' ends.
    const double fastest = kind == ContactKind::VertexTriangle
                               ? speed[0] + std::max({speed[1], speed[2], speed[3]})
                               : std::max(speed[0], speed[1]) + std::max(speed[2], speed[3]);
    const double start = contact_gap(kind, p).distance;
    const double kept = kKept * std::min(start, gap);
    double part = 0;
    double advance = (start - kept) / fastest;
    if (!(advance < 1)) return 1;
    for (int i = 0; i < kMostAdvances; ++i) {
        for (std::size_t k = 0; k < 4; ++k) p[k] += advance * own[k];
        const double distance = contact_gap(kind, p).distance;
        if (i > 0 && distance < kept) break;
        part += advance;
        if (part >= 1) return 1;
        advance = kAdvance * distance / fastest;
    }
    return part;
}

}  // namespace windfall::drying
