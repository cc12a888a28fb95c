// Mean curvature: Meyer, Desbrun, Schroeder, Barr, "Discrete differential-geometry operators for triangulated
// 2-manifolds" (2003), doi:10.1007/978-3-662-05105-4_2. A quadrilateral counts as the mean of its two cuts
// into triangles, so that the result does not depend on a choice of diagonal.
#include "picture/colouring.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "picture/image.h"
#include "picture/names.h"

namespace windfall::picture {
namespace {

using geometry::Face;
using geometry::Vec3;

/// Magnitudes up to this share of the vertices span the diverging colours; the rest is cut, so that a few
/// sharp creases do not make all else pale.
constexpr double kFalseColourFraction = 0.9;

/// Displayed colours of pith, heartwood, sapwood, phloem and bark.
constexpr std::array<std::array<double, 3>, 5> kTissueColours{
    {{0.55, 0.30, 0.65}, {0.80, 0.36, 0.24}, {0.95, 0.80, 0.45}, {0.42, 0.66, 0.33}, {0.40, 0.38, 0.40}}};

/// Linear RGB between displayed colours that are evenly spread over t in [0, 1].
std::array<float, 3> colour_between(const std::array<std::array<double, 3>, 5>& stops, double t) {
    const double place =
        std::isfinite(t) ? static_cast<double>(stops.size() - 1) * std::clamp(t, 0.0, 1.0) : 0;
    const auto stop = std::min<std::size_t>(static_cast<std::size_t>(place), stops.size() - 2);
    const double part = place - static_cast<double>(stop);
    std::array<float, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] =
            linear_from_srgb(static_cast<float>((1 - part) * stops[stop][c] + part * stops[stop + 1][c]));
    return colour;
}

std::vector<double> attribute_values(const std::string& name, const take::TakeMesh& mesh,
                                     const take::FrameMesh& moved) {
    const take::Attribute* found = moved.find(name);
    if (found == nullptr) found = mesh.find(name);
    if (found == nullptr || found->values.size() != moved.positions.size())
        throw InputError(
            fmt::format("mesh \"{}\" has no {} at its vertices; choose another colouring", mesh.name, name));
    return {found->values.begin(), found->values.end()};
}

/// Sums at the vertices.
struct Stars {
    std::vector<Vec3> area_gradient;
    std::vector<double> voronoi, barycentric;  // areas

    explicit Stars(std::size_t count)
        : area_gradient(count, Vec3::Zero()), voronoi(count, 0.0), barycentric(count, 0.0) {}

    void add(const std::vector<Vec3>& x, std::array<std::int32_t, 3> corners, double weight) {
        const auto at = [&](std::size_t k) { return static_cast<std::size_t>(corners[k % 3]); };
        const Vec3 cross = (x[at(1)] - x[at(0)]).cross(x[at(2)] - x[at(0)]);
        const double twice_area = cross.norm();
        if (!(twice_area > 0)) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &p = x[at(k)], &q = x[at(k + 1)], &r = x[at(k + 2)];
            // d area / d p = normal x opposite edge / 2; this is the cotangent formula, corner by corner
            area_gradient[at(k)] += weight * 0.5 * (cross / twice_area).cross(r - q);
            const double cot_q = (p - q).dot(r - q) / twice_area, cot_r = (p - r).dot(q - r) / twice_area;
            voronoi[at(k)] += weight * ((p - r).squaredNorm() * cot_q + (p - q).squaredNorm() * cot_r) / 8;
            barycentric[at(k)] += weight * twice_area / 6;
        }
    }
    /// The Voronoi area makes the curvature of a sphere right at vertices of any valence; where obtuse
    /// triangles spoil it, a part of the barycentric area keeps it positive.
    double area(std::size_t v) const { return std::max(voronoi[v], 0.5 * barycentric[v]); }
};

}  // namespace

Colouring colouring_named(const std::string& name) {
    return choice_named<Colouring>("colouring", colouring_names(), name);
}

const std::vector<std::string>& colouring_names() {
    static const std::vector<std::string> names{"material", "curvature", "depth",
                                                "tissue",   "height",    "moisture"};
    return names;
}

std::vector<double> mean_curvature(const std::vector<Vec3>& positions, const std::vector<Face>& faces) {
    Stars stars(positions.size());
    for (const Face& f : faces) {
        if (geometry::corner_count(f) == 3) {
            stars.add(positions, {f[0], f[1], f[2]}, 1);
        } else {
            stars.add(positions, {f[0], f[1], f[2]}, 0.5);
            stars.add(positions, {f[0], f[2], f[3]}, 0.5);
            stars.add(positions, {f[0], f[1], f[3]}, 0.5);
            stars.add(positions, {f[1], f[2], f[3]}, 0.5);
        }
    }
    const auto normals = geometry::vertex_normals(positions, faces);
    std::vector<double> curvature(positions.size(), 0.0);
    // The area gradient at a vertex is 2 H n times its area.
    for (std::size_t v = 0; v < positions.size(); ++v)
        if (stars.area(v) > 0) curvature[v] = stars.area_gradient[v].dot(normals[v]) / (2 * stars.area(v));
    return curvature;
}

double robust_magnitude(std::span<const std::vector<double>> sets, double fraction) {
    std::vector<double> magnitudes;
    for (const auto& set : sets)
        for (const double value : set)
            if (std::isfinite(value)) magnitudes.push_back(std::abs(value));
    if (magnitudes.empty()) return 1;
    const auto last = static_cast<double>(magnitudes.size() - 1);
    const auto at = magnitudes.begin() + static_cast<std::ptrdiff_t>(std::clamp(fraction, 0.0, 1.0) * last);
    std::nth_element(magnitudes.begin(), at, magnitudes.end());
    return *at > 0 ? *at : 1;
}

std::vector<double> shown_values(Colouring colouring, const take::TakeMesh& mesh,
                                 const take::FrameMesh& moved) {
    switch (colouring) {
        case Colouring::Material:
            break;
        case Colouring::Curvature: {
            std::vector<Vec3> positions(moved.positions.size());
            for (std::size_t v = 0; v < positions.size(); ++v)
                positions[v] = moved.positions[v].cast<double>();
            return mean_curvature(positions, mesh.rest.faces);
        }
        case Colouring::Depth: {
            std::vector<double> values = attribute_values("depth", mesh, moved);
            for (double& depth : values) depth = -depth;
            return values;
        }
        case Colouring::Tissue:
            return attribute_values("tissue", mesh, moved);
        case Colouring::Height:
            return attribute_values("height", mesh, moved);
        case Colouring::Moisture:
            return attribute_values("moisture", mesh, moved);
    }
    return {};
}

ColourRange colour_range(Colouring colouring, std::span<const std::vector<double>> sets) {
    if (colouring == Colouring::Tissue) return {0, static_cast<double>(kTissueColours.size() - 1)};
    if (colouring == Colouring::Moisture) return {1, 0};
    if (colouring != Colouring::Height) {
        const double magnitude = robust_magnitude(sets, kFalseColourFraction);
        return {-magnitude, magnitude};
    }
    ColourRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const auto& set : sets)
        for (const double value : set)
            if (std::isfinite(value)) range = {std::min(range.low, value), std::max(range.high, value)};
    return range.low < range.high ? range : ColourRange{};
}

std::array<float, 3> shown_colour(Colouring colouring, double value, const ColourRange& range) {
    const double t = (value - range.low) / (range.high - range.low);
    switch (colouring) {
        case Colouring::Tissue:
            return colour_between(kTissueColours, t);
        case Colouring::Height:
        case Colouring::Moisture:
            return sequential_colour(t);
        default:
            return diverging_colour(2 * t - 1);
    }
}

std::array<float, 3> diverging_colour(double t) {
    // Displayed colours at t = -1, -1/2, 0, 1/2, 1.
    static constexpr std::array<std::array<double, 3>, 5> kStops{
        {{0.10, 0.25, 0.90}, {0.47, 0.62, 0.97}, {0.94, 0.94, 0.94}, {0.97, 0.58, 0.48}, {0.92, 0.19, 0.09}}};
    return colour_between(kStops, (t + 1) / 2);
}

std::array<float, 3> sequential_colour(double t) {
    static constexpr std::array<std::array<double, 3>, 5> kStops{{{0.267, 0.005, 0.329},
                                                                  {0.229, 0.322, 0.546},
                                                                  {0.128, 0.567, 0.551},
                                                                  {0.369, 0.789, 0.383},
                                                                  {0.993, 0.906, 0.144}}};
    return colour_between(kStops, t);
}

}  // namespace windfall::picture
