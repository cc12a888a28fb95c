#include "drying/ridges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace windfall::drying {

using geometry::Face;
using geometry::Vec3;

namespace {

/// Integrals over the fresh surface of the squared gradient of depth: all of it, and its parts along the
/// meridians and along the circles of latitude.
struct GradientIntegrals {
    double all = 0;
    double meridional = 0;
    double latitudinal = 0;
};

GradientIntegrals gradient_integrals(const std::vector<Vec3>& rest, const std::vector<Face>& faces,
                                     const std::vector<double>& depth) {
    GradientIntegrals sums;
    for (const Face& face : faces) {
        // A bilinear field at the middle of a quadrilateral: its differences along the two diagonals.
        const bool triangle = geometry::corner_count(face) == 3;
        const int last = triangle ? face[0] : face[3];
        const Vec3 d1 = rest[face[2]] - rest[face[0]];
        const Vec3 d2 = rest[last] - rest[face[1]];
        const Vec3 normal = d1.cross(d2);
        const double area = 0.5 * normal.norm();
        if (area == 0) continue;
        const Vec3 n = normal.normalized();
        const double w1 = depth[face[2]] - depth[face[0]];
        const double w2 = depth[last] - depth[face[1]];
        // The tangent vector g with g.d1 = w1, g.d2 = w2
        const Vec3 gradient = (w1 * d2.cross(n) + w2 * n.cross(d1)) / (2 * area);
        const Vec3 middle = 0.25 * (rest[face[0]] + rest[face[1]] + rest[face[2]] + rest[last]);
        const Vec3 east = Vec3::UnitY().cross(middle);
        sums.all += area * gradient.squaredNorm();
        if (east.norm() < 1e-12) continue;
        const double along = gradient.dot(east.normalized());
        sums.latitudinal += area * along * along;
        sums.meridional += area * (gradient.squaredNorm() - along * along);
    }
    return sums;
}

int latitude_band(const Vec3& position) {
    const double latitude = std::atan2(position.y(), std::hypot(position.x(), position.z()));
    const int band = static_cast<int>((latitude / std::numbers::pi + 0.5) * kLatitudeBands);
    return std::clamp(band, 0, kLatitudeBands - 1);
}

int find_root(std::vector<int>& parent, int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

}  // namespace

int count_valleys(const std::vector<Face>& faces, const std::vector<double>& depth, double depth_rms) {
    constexpr double kEdge = 0.5;  // a region's edge, in root mean squares
    constexpr double kFloor = 1;   // how deep it must reach to count: lesser dents are noise
    std::vector<int> parent(depth.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto deep = [&](int v) { return depth[v] > kEdge * depth_rms; };
    for (const Face& face : faces) {
        const int corners = geometry::corner_count(face);
        for (int c = 0; c < corners; ++c) {
            const int v = face[c];
            const int w = face[(c + 1) % corners];
            if (deep(v) && deep(w)) parent[find_root(parent, v)] = find_root(parent, w);
        }
    }
    std::vector<char> reaches(depth.size(), 0);
    for (std::size_t v = 0; v < depth.size(); ++v)
        if (depth[v] > kFloor * depth_rms) reaches[find_root(parent, static_cast<int>(v))] = 1;
    return static_cast<int>(std::count(reaches.begin(), reaches.end(), 1));
}

RidgeMeasures measure_ridges(const std::vector<Vec3>& rest, const std::vector<Face>& faces,
                             const std::vector<double>& depth) {
    const std::vector<double> areas = geometry::vertex_areas(rest, faces);
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    double mean = 0;
    for (std::size_t v = 0; v < depth.size(); ++v) mean += areas[v] * depth[v] / area;
    std::vector<double> centred(depth);
    for (double& d : centred) d -= mean;

    RidgeMeasures result;
    std::vector<double> band_sum(kLatitudeBands, 0.0);
    std::vector<double> band_area(kLatitudeBands, 0.0);
    double sum = 0;
    for (std::size_t v = 0; v < depth.size(); ++v) {
        const double square = areas[v] * centred[v] * centred[v];
        const int band = latitude_band(rest[v]);
        sum += square;
        band_sum[band] += square;
        band_area[band] += areas[v];
    }
    result.depth_rms = std::sqrt(sum / area);
    for (int band = 0; band < kLatitudeBands; ++band)
        result.depth_rms_by_latitude.push_back(
            band_area[band] > 0 ? std::sqrt(band_sum[band] / band_area[band]) : 0);
    const GradientIntegrals gradients = gradient_integrals(rest, faces, centred);
    if (gradients.all > 0) {
        result.wavelength = 2 * std::numbers::pi * std::sqrt(sum / gradients.all);
        // Ridges along the meridians vary along the circles of latitude.
        result.meridian_alignment = (gradients.latitudinal - gradients.meridional) / gradients.all;
        result.valleys = count_valleys(faces, centred, result.depth_rms);
    }
    return result;
}

}  // namespace windfall::drying
