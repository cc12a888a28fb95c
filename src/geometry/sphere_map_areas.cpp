#include "geometry/sphere_map_areas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>

namespace windfall::geometry {

namespace {

constexpr int kAxes = 24;
constexpr double kDamping = 0.3;
constexpr int kHalvings = 3;
/// Latitudes are told as asinh(tan latitude), in which a Moebius map along the axis is a shift.
constexpr double kLargestPsi = 20;
constexpr int kPsiBins = 2048, kKnots = 64;

/// A rotation that takes z to `axis`.
Eigen::Matrix3d frame_along(const Vec3& axis) {
    const Vec3 other = std::abs(axis.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
    Eigen::Matrix3d frame;
    frame.col(2) = axis.normalized();
    frame.col(0) = other.cross(frame.col(2)).normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
}

/// The vertex furthest from `start` along the edges.
std::int32_t furthest_vertex(const TriangleSurface& surface, std::int32_t start) {
    std::vector<std::vector<std::int32_t>> neighbours(surface.positions.size());
    for (const Triangle& t : surface.triangles)
        for (int k = 0; k < 3; ++k) neighbours[t[k]].push_back(t[(k + 1) % 3]);
    std::vector<double> distance(surface.positions.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[start] = 0;
    queue.push({0, start});
    std::int32_t furthest = start;
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        furthest = v;
        for (const std::int32_t next : neighbours[v]) {
            const double further = d + (surface.positions[next] - surface.positions[v]).norm();
            if (further >= distance[next]) continue;
            distance[next] = further;
            queue.push({further, next});
        }
    }
    return furthest;
}

/// The Moebius map that leaves `one` where it is and takes `other` opposite to it.
std::vector<Vec3> with_opposite_ends(const std::vector<Vec3>& directions, std::int32_t one,
                                     std::int32_t other) {
    using Complex = std::complex<double>;
    const Eigen::Matrix3d frame = frame_along(directions[one]);
    const auto stereographic = [&](const Vec3& direction) {
        const Vec3 d = frame.transpose() * direction;
        return Complex(d.x(), d.y()) / std::max(1 - d.z(), 1e-15);
    };
    const Complex shift = stereographic(directions[other]);
    std::vector<Vec3> result(directions.size());
    for (std::size_t v = 0; v < result.size(); ++v) {
        const Complex w = stereographic(directions[v]) - shift;
        const double r = std::norm(w);
        result[v] = frame * Vec3(2 * w.real(), 2 * w.imag(), r - 1) / (r + 1);
    }
    result[one] = directions[one];
    return result;
}

double psi_of(double z, double rho) {
    return std::clamp(std::asinh(z / std::max(rho, 1e-12)), -kLargestPsi, kLargestPsi);
}

/// For kKnots shares of the area: the latitude up to which the surface holds it (from), and up to which the
/// sphere does (to).
struct Latitudes {
    std::vector<double> from, to;

    double moved(double psi) const {
        const auto above = std::upper_bound(from.begin(), from.end(), psi) - from.begin();
        if (above == 0) return to.front() + psi - from.front();
        if (above == static_cast<std::ptrdiff_t>(from.size())) return to.back() + psi - from.back();
        const double share = (psi - from[above - 1]) / (from[above] - from[above - 1]);
        return to[above - 1] + share * (to[above] - to[above - 1]);
    }
};

/// Each triangle's area counts evenly over its latitudes: vertices alone would make steps of a mesh's rows.
Latitudes latitudes_by_area(const TriangleSurface& surface, const std::vector<double>& areas,
                            const std::vector<double>& psi) {
    constexpr double kWidth = 2 * kLargestPsi / kPsiBins;
    std::vector<double> area(kPsiBins, 0.0);
    double total = 0;
    for (std::size_t t = 0; t < areas.size(); ++t) {
        const auto& [a, b, c] = surface.triangles[t];
        const auto [lowest, highest] = std::minmax({psi[a], psi[b], psi[c]});
        const double low = (lowest + kLargestPsi) / kWidth, high = (highest + kLargestPsi) / kWidth + 1e-9;
        const int first = std::clamp(static_cast<int>(low), 0, kPsiBins - 1);
        const int last = std::clamp(static_cast<int>(high), 0, kPsiBins - 1);
        for (int bin = first; bin <= last; ++bin) {
            const double overlap = std::min(high, bin + 1.0) - std::max(low, static_cast<double>(bin));
            area[bin] += areas[t] * std::max(overlap, 0.0) / (high - low);
        }
        total += areas[t];
    }
    Latitudes result;
    double below = 0;
    int bin = 0;
    for (int k = 0; k < kKnots; ++k) {
        const double share = (k + 0.5) / kKnots;
        while (bin < kPsiBins - 1 && below + area[bin] < share * total) below += area[bin++];
        const double within = area[bin] > 0 ? (share * total - below) / area[bin] : 0.5;
        const double psi_knot = (bin + within) * kWidth - kLargestPsi;
        if (!result.from.empty() && psi_knot <= result.from.back()) continue;
        result.from.push_back(psi_knot);
        result.to.push_back(std::atanh(2 * share - 1));
    }
    return result;
}

/// Latitudes about an axis moved by `damping` of the way to where areas are even.
std::vector<Vec3> evened(const TriangleSurface& surface, const std::vector<double>& areas,
                         const std::vector<Vec3>& directions, const Vec3& axis, double damping) {
    const Eigen::Matrix3d frame = frame_along(axis);
    std::vector<double> psi(directions.size());
    std::vector<Vec3> result(directions.size());
    for (std::size_t v = 0; v < psi.size(); ++v) {
        result[v] = frame.transpose() * directions[v];
        psi[v] = psi_of(result[v].z(), result[v].head<2>().norm());
    }
    const Latitudes latitudes = latitudes_by_area(surface, areas, psi);
    for (std::size_t v = 0; v < psi.size(); ++v) {
        const double moved = psi[v] + damping * (latitudes.moved(psi[v]) - psi[v]);
        const double rho = result[v].head<2>().norm();
        // A pole stays a pole: it has no longitude.
        if (rho < 1e-12) {
            result[v] = directions[v];
            continue;
        }
        const double wanted = 1 / std::cosh(moved);
        result[v] =
            frame * Vec3(result[v].x() * wanted / rho, result[v].y() * wanted / rho, std::tanh(moved));
    }
    return result;
}

bool is_one_to_one(const TriangleSurface& surface, const std::vector<Vec3>& directions) {
    return std::all_of(surface.triangles.begin(), surface.triangles.end(),
                       [&](const Triangle& t) { return sphere_orientation(directions, t) > 0; });
}

}  // namespace

double sphere_orientation(const std::vector<Vec3>& directions, const Triangle& triangle) {
    const Vec3& a = directions[triangle[0]];
    return (directions[triangle[1]] - a).cross(directions[triangle[2]] - a).dot(a);
}

std::array<std::int32_t, 2> ends_of(const TriangleSurface& surface) {
    const std::int32_t one = furthest_vertex(surface, furthest_vertex(surface, 0));
    return {one, furthest_vertex(surface, one)};
}

void spread_areas(const TriangleSurface& surface, std::vector<Vec3>& directions) {
    std::vector<double> areas;
    areas.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        const Vec3& a = surface.positions[t[0]];
        areas.push_back((surface.positions[t[1]] - a).cross(surface.positions[t[2]] - a).norm() / 2);
    }
    const auto [one, other] = ends_of(surface);
    const auto take = [&](std::vector<Vec3> next) {
        const bool sound = is_one_to_one(surface, next);
        if (sound) directions = std::move(next);
        return sound;
    };
    const auto even_about = [&](const Vec3& axis, double damping) {
        for (int k = 0; k < kHalvings; ++k, damping /= 2)
            if (take(evened(surface, areas, directions, axis, damping))) return;
    };
    take(with_opposite_ends(directions, one, other));
    even_about(directions[one], 1);
    for (int k = 0; k < kAxes; ++k) {
        // Points of a Fibonacci lattice on half the sphere, with a stride so that neighbours do not follow
        // each other.
        const int i = 7 * k % kAxes;
        const double z = (i + 0.5) / kAxes, rho = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
        even_about({rho * std::cos(angle), rho * std::sin(angle), z}, kDamping);
    }
}

}  // namespace windfall::geometry
