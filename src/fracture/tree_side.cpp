// Which part of a tree falls.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "fracture/tree_cut.h"
#include "fracture/tree_text.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

/// The section through the branch where it was picked.
Section picked_section(SectionTracer& tracer, std::span<const std::int32_t> near, const TreeBranch& branch) {
    for (const Section& section : tracer.cut(near, branch.centre, branch.axis))
        if (section.closed && section.encloses(branch.centre)) return section;
    throw InputError(fmt::format("the branch is not closed at {}; close its holes and export it again",
                                 text_of(branch.point)));
}

/// Mean area of sections within two radii to one side; 0 when there is none.
double mean_area(SectionTracer& tracer, std::span<const std::int32_t> near, const TreeBranch& branch,
                 double direction) {
    double sum = 0;
    int count = 0;
    for (const double reach : {0.5, 1.0, 1.5, 2.0}) {
        const Vec3 origin = branch.centre + direction * reach * branch.radius * branch.axis;
        for (const Section& section : tracer.cut(near, origin, branch.axis))
            if (section.closed && section.encloses(origin)) {
                sum += section.area;
                ++count;
                break;
            }
    }
    return count > 0 ? sum / count : 0;
}

/// The two parts of the branch's body: sets of vertices, and the set's number on either side of the section.
struct TwoParts {
    DisjointSets sets;
    std::int32_t below = -1, above = -1;
};

TwoParts parted(const TreeSurface& surface, const Section& section) {
    TwoParts parts{DisjointSets(surface.positions.size())};
    std::vector<bool> is_cut(surface.triangles.size(), false);
    for (const SectionPoint& p : section.points) is_cut[static_cast<std::size_t>(p.triangle)] = true;
    const auto is_above = [&](std::int32_t v) {
        return (surface.positions[static_cast<std::size_t>(v)] - section.origin).dot(section.normal) >= 0;
    };
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& v = surface.triangles[t].vertices;
        for (std::size_t k = 0; k < 3; ++k)
            if (!is_cut[t] || is_above(v[k]) == is_above(v[(k + 1) % 3]))
                parts.sets.join(v[k], v[(k + 1) % 3]);
    }
    const SectionPoint& p = section.points[0];
    parts.below = parts.sets.find(is_above(p.low) ? p.high : p.low);
    parts.above = parts.sets.find(is_above(p.low) ? p.low : p.high);
    return parts;
}

double area_of(const TreeSurface& surface, DisjointSets& sets, std::int32_t set) {
    double area = 0;
    for (const TreeTriangle& triangle : surface.triangles)
        if (sets.find(triangle.vertices[0]) == set) area += 0.5 * surface.twice_area(triangle).norm();
    return area;
}

}  // namespace

void point_to_falling_side(const TreeSurface& surface, SectionTracer& tracer, const TreeBreakOptions& options,
                           TreeBranch& branch) {
    const auto near = triangles_near(surface, branch.component, branch.centre, 6 * branch.radius);
    TwoParts parts = parted(surface, picked_section(tracer, near, branch));
    if (parts.below == parts.above)
        throw InputError(
            fmt::format("cutting the branch at {} would not part the tree: both sides hold together "
                        "elsewhere; pick a branch that ends freely",
                        text_of(branch.point)));
    bool above_falls = true;
    if (options.falls == FallingSide::AwayFromRoot) {
        std::int32_t lowest = 0;
        for (std::size_t v = 1; v < surface.positions.size(); ++v)
            if (surface.positions[v].dot(options.up) <
                surface.positions[static_cast<std::size_t>(lowest)].dot(options.up))
                lowest = static_cast<std::int32_t>(v);
        const std::int32_t root = parts.sets.find(lowest);
        if (root == parts.below || root == parts.above)
            above_falls = root == parts.below;
        else
            above_falls = mean_area(tracer, near, branch, 1) <= mean_area(tracer, near, branch, -1);
    } else {
        const double below = area_of(surface, parts.sets, parts.below),
                     above = area_of(surface, parts.sets, parts.above);
        above_falls = (options.falls == FallingSide::Smaller) == (above <= below);
    }
    if (!above_falls) branch.axis = -branch.axis;
}

}  // namespace windfall::fracture
