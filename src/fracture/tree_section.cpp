#include "fracture/tree_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace windfall::fracture {
namespace {

using geometry::Vec3;

// A vertex in the plane counts as above it: then every triangle that is crossed at all is crossed at two
// edges.
bool is_above(double height) { return height >= 0; }

void measure_section(Section& section) {
    Vec3 sum = Vec3::Zero();
    for (const SectionPoint& p : section.points) sum += p.position;
    section.centroid = sum / static_cast<double>(section.points.size());
    if (!section.closed) return;
    double twice_area = 0;
    Vec3 moment = Vec3::Zero();
    const Vec3 about = section.centroid;
    for (std::size_t i = 0; i < section.points.size(); ++i) {
        const Vec3 a = section.points[i].position - about;
        const Vec3 b = section.points[(i + 1) % section.points.size()].position - about;
        const double piece = a.cross(b).dot(section.normal);
        twice_area += piece;
        moment += piece * (a + b) / 3;
    }
    section.area = 0.5 * twice_area;
    if (twice_area != 0) section.centroid = about + moment / twice_area;
}

}  // namespace

double Section::radius() const { return std::sqrt(std::max(area, 0.0) / std::numbers::pi); }

double Section::outer_radius(const Vec3& centre) const {
    double most = 0;
    for (const SectionPoint& p : points) most = std::max(most, (p.position - centre).norm());
    return most;
}

double Section::inner_radius(const Vec3& centre) const { return distance(centre); }

double Section::distance(const Vec3& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3& a = points[i].position;
        const Vec3 ab = points[(i + 1) % points.size()].position - a;
        const double length_sq = ab.squaredNorm();
        const double share = length_sq > 0 ? std::clamp(ab.dot(point - a) / length_sq, 0.0, 1.0) : 0.0;
        least = std::min(least, (a + share * ab - point).norm());
    }
    return least;
}

bool Section::encloses(const Vec3& point) const {
    double turned = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 a = points[i].position - point;
        const Vec3 b = points[(i + 1) % points.size()].position - point;
        turned += std::atan2(a.cross(b).dot(normal), a.dot(b));
    }
    return turned > std::numbers::pi;
}

Section SectionTracer::follow(std::int32_t start, const Vec3& origin, const Vec3& normal) {
    Section section{origin, normal, {}, false, Vec3::Zero(), 0};
    const auto height = [&](std::int32_t v) {
        return (m_surface.positions[static_cast<std::size_t>(v)] - origin).dot(normal);
    };
    std::int32_t triangle = start;
    while (true) {
        const auto index = static_cast<std::size_t>(triangle);
        m_stamp[index] = m_cut;
        const auto& v = m_surface.triangles[index].vertices;
        const std::array<double, 3> h{height(v[0]), height(v[1]), height(v[2])};
        // The loop enters over the edge that goes down and leaves over the one that goes up.
        std::size_t in = 0, out = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_above(h[k]) && !is_above(h[(k + 1) % 3])) in = k;
            if (!is_above(h[k]) && is_above(h[(k + 1) % 3])) out = k;
        }
        SectionPoint point{v[in], v[(in + 1) % 3], 0, Vec3::Zero(), triangle};
        if (point.low > point.high) std::swap(point.low, point.high);
        const double below = height(point.low), above = height(point.high);
        point.share = below / (below - above);
        point.position = (1 - point.share) * m_surface.positions[static_cast<std::size_t>(point.low)] +
                         point.share * m_surface.positions[static_cast<std::size_t>(point.high)];
        section.points.push_back(point);
        triangle = m_surface.neighbours[index][out];
        if (triangle == start) section.closed = true;
        // A loop that comes back to itself elsewhere passed through an edge of more than two faces.
        if (triangle < 0 || m_stamp[static_cast<std::size_t>(triangle)] == m_cut) break;
    }
    measure_section(section);
    return section;
}

std::vector<Section> SectionTracer::cut(std::span<const std::int32_t> triangles, const Vec3& origin,
                                        const Vec3& normal) {
    ++m_cut;
    std::vector<Section> sections;
    for (const std::int32_t t : triangles) {
        if (m_stamp[static_cast<std::size_t>(t)] == m_cut) continue;
        const TreeTriangle& triangle = m_surface.triangles[static_cast<std::size_t>(t)];
        int above = 0;
        for (std::size_t k = 0; k < 3; ++k)
            above += is_above((m_surface.corner(triangle, k) - origin).dot(normal)) ? 1 : 0;
        if (above == 1 || above == 2) sections.push_back(follow(t, origin, normal));
    }
    return sections;
}

}  // namespace windfall::fracture
