#include "fracture/tree_branch.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "fracture/tree_text.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);

/// How far it is from a place of the surface straight through the body; nothing when there is no other side.
std::optional<double> thickness(const TreeSurface& surface, const SurfacePlace& place, const Vec3& inwards,
                                std::int32_t component) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const TreeTriangle& t = surface.triangles[i];
        if (surface.component[static_cast<std::size_t>(t.vertices[0])] != component) continue;
        const Vec3& a = surface.corner(t, 0);
        const Vec3 ab = surface.corner(t, 1) - a, ac = surface.corner(t, 2) - a, normal = ab.cross(ac);
        const double slope = normal.dot(inwards);
        if (slope <= 0) continue;  // only where a ray leaves the body
        const double way = normal.dot(a - place.position) / slope;
        const Vec3 hit = place.position + way * inwards - a;
        const double u = hit.cross(ac).dot(normal), v = ab.cross(hit).dot(normal);
        if (u < 0 || v < 0 || u + v > normal.squaredNorm()) continue;
        if (way > 0) least = std::min(least, way);
    }
    if (!std::isfinite(least)) return std::nullopt;
    return least;
}

/// The body that was meant, and how thick it is there.
struct PickedBody {
    SurfacePlace place;
    std::int32_t component = 0;
    Vec3 inwards = Vec3::Zero();
    std::optional<double> through;
};

/// The nearest body that has another side: leaves in front of a branch have none. Where no body near has one,
/// the nearest.
PickedBody picked_body(const TreeSurface& surface, const Vec3& at) {
    constexpr std::size_t kMostTried = 64;
    std::vector<std::pair<double, SurfacePlace>> nearest(
        static_cast<std::size_t>(surface.components),
        {std::numeric_limits<double>::infinity(), SurfacePlace{}});
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const std::int32_t vertex = surface.triangles[t].vertices[0];
        auto& [least, best] =
            nearest[static_cast<std::size_t>(surface.component[static_cast<std::size_t>(vertex)])];
        const SurfacePlace place = nearest_place(surface, static_cast<std::int32_t>(t), at);
        const double distance = (place.position - at).norm();
        if (distance >= least) continue;
        least = distance;
        best = place;
    }
    const std::size_t tried = std::min(kMostTried, nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(tried), nearest.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
    PickedBody first;
    for (std::size_t i = 0; i < tried && nearest[i].second.triangle >= 0; ++i) {
        PickedBody body;
        body.place = nearest[i].second;
        const TreeTriangle& triangle = surface.triangles[static_cast<std::size_t>(body.place.triangle)];
        body.component = surface.component[static_cast<std::size_t>(triangle.vertices[0])];
        body.inwards = -surface.twice_area(triangle).normalized();
        body.through = thickness(surface, body.place, body.inwards, body.component);
        if (body.through) return body;
        if (i == 0) first = body;
    }
    return first;
}

/// The closed loop that is nearest to `point` of those that a plane cuts; null when there is none.
const Section* nearest_loop(const std::vector<Section>& sections, const Vec3& point) {
    const Section* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Section& section : sections) {
        const double distance = section.distance(point);
        if (!section.closed || distance >= least) continue;
        least = distance;
        best = &section;
    }
    return best;
}

/// The direction whose section through `centre` is smallest, of those all over the half sphere.
std::optional<Section> smallest_section(SectionTracer& tracer, std::span<const std::int32_t> near,
                                        const Vec3& centre, const Vec3& point) {
    constexpr int kDirections = 96;
    std::optional<Section> best;
    for (int i = 0; i < kDirections; ++i) {
        const double z = (i + 0.5) / kDirections, r = std::sqrt(1 - z * z), angle = kGoldenAngle * i;
        const Vec3 normal(r * std::cos(angle), r * std::sin(angle), z);
        const std::vector<Section> sections = tracer.cut(near, centre, normal);
        const Section* loop = nearest_loop(sections, point);
        if (loop == nullptr || loop->area == 0) continue;
        if (!best || std::abs(loop->area) < std::abs(best->area)) best = *loop;
    }
    return best;
}

std::optional<Section> section_around(SectionTracer& tracer, std::span<const std::int32_t> near,
                                      const Vec3& origin, const Vec3& normal) {
    const std::vector<Section> sections = tracer.cut(near, origin, normal);
    const Section* loop = nearest_loop(sections, origin);
    for (const Section& section : sections)
        if (section.closed && section.encloses(origin)) loop = &section;
    return loop != nullptr ? std::optional<Section>(*loop) : std::nullopt;
}

/// Turns the axis into the line through the centroids of sections on both sides, until it stays.
void straighten(SectionTracer& tracer, std::span<const std::int32_t> near, TreeBranch& branch) {
    for (int round = 0; round < 12; ++round) {
        const Vec3 reach = 0.5 * branch.radius * branch.axis;
        const auto below = section_around(tracer, near, branch.centre - reach, branch.axis);
        const auto above = section_around(tracer, near, branch.centre + reach, branch.axis);
        if (!below || !above || below->area <= 0 || above->area <= 0) return;
        // Near a fork one of the two is another branch, or the fork itself.
        if (std::max(below->area, above->area) > 3 * std::min(below->area, above->area)) return;
        const Vec3 axis = (above->centroid - below->centroid).normalized();
        const Vec3 foot = branch.centre + axis * (branch.point - branch.centre).dot(axis);
        const auto middle = section_around(tracer, near, foot, axis);
        if (!middle || middle->area <= 0) return;
        const double turned = axis.cross(branch.axis).norm();
        branch.axis = axis;
        branch.centre = middle->centroid;
        branch.radius = middle->radius();
        if (turned < 1e-4) return;
    }
}

}  // namespace

std::vector<std::int32_t> triangles_near(const TreeSurface& surface, std::int32_t component,
                                         const Vec3& centre, double half_size) {
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const TreeTriangle& t = surface.triangles[i];
        if (surface.component[static_cast<std::size_t>(t.vertices[0])] != component) continue;
        const Vec3 a = surface.corner(t, 0) - centre, b = surface.corner(t, 1) - centre,
                   c = surface.corner(t, 2) - centre;
        const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        if (low.maxCoeff() <= half_size && high.minCoeff() >= -half_size)
            near.push_back(static_cast<std::int32_t>(i));
    }
    return near;
}

TreeBranch find_branch(const TreeSurface& surface, SectionTracer& tracer, const Vec3& at) {
    if (!at.allFinite()) throw InputError("the point to break at is not finite; give --at three numbers");
    constexpr double kFarthest = 1e100;  // the squares of distances beyond are no numbers
    if (at.cwiseAbs().maxCoeff() > kFarthest)
        throw InputError(
            fmt::format("the point {} is far off the tree; give one on the branch's surface", text_of(at)));
    const PickedBody picked = picked_body(surface, at);
    if (picked.place.triangle < 0)
        throw InputError("the tree has no surface; export it as a mesh of polygons");
    TreeBranch branch;
    branch.point = picked.place.position;
    branch.component = picked.component;
    const std::string where = text_of(branch.point);
    const double off = (at - branch.point).norm();
    if (!picked.through)
        throw InputError(
            fmt::format("the tree is no closed body at {}: behind its surface there is no other side "
                        "facing away; close its holes, or turn its normals outwards, and export it again",
                        where));
    branch.radius = 0.5 * *picked.through;
    branch.centre = branch.point + branch.radius * picked.inwards;

    const auto near = triangles_near(surface, branch.component, branch.centre, 12 * branch.radius);
    const auto smallest = smallest_section(tracer, near, branch.centre, branch.point);
    if (!smallest)
        throw InputError(
            fmt::format("the branch is not closed at {}: no cross-section comes back to itself; "
                        "close its holes, merge vertices at one place, and export it again",
                        where));
    if (smallest->area < 0)
        throw InputError(fmt::format(
            "the tree is inside out at {}; turn its normals outwards and export it again", where));
    branch.axis = smallest->normal;
    branch.centre = smallest->centroid;
    branch.radius = smallest->radius();
    straighten(tracer, near, branch);
    if (off > branch.radius)
        throw InputError(
            fmt::format("the point {} is {:.3g} off the tree, more than the branch there is thick; the "
                        "nearest place of the tree is --at {}",
                        text_of(at), off, where));
    return branch;
}

}  // namespace windfall::fracture
