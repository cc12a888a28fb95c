#include "fracture/tree_cut.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "fracture/tree_hangers.h"
#include "fracture/tree_text.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

/// Whether the loop turns one way about `centre`, once, and keeps clear of vertices and of the centre.
bool is_clean(const TreeSurface& surface, const Section& section, const Vec3& centre, double radius) {
    const double clearance = 1e-4 * radius;
    double turned = 0;
    for (std::size_t i = 0; i < section.points.size(); ++i) {
        const SectionPoint& p = section.points[i];
        for (const std::int32_t v : {p.low, p.high})
            if (std::abs(
                    (surface.positions[static_cast<std::size_t>(v)] - section.origin).dot(section.normal)) <
                clearance)
                return false;
        const Vec3 a = p.position - centre,
                   b = section.points[(i + 1) % section.points.size()].position - centre;
        const double turn = std::atan2(a.cross(b).dot(section.normal), a.dot(b));
        if (turn <= 1e-7) return false;
        turned += turn;
    }
    return section.closed && std::abs(turned - 2 * std::numbers::pi) < 1e-6;
}

/// The first clean loop from `height` on in `direction`; gives the height it was found at.
Section clean_loop(const TreeSurface& surface, SectionTracer& tracer, std::span<const std::int32_t> near,
                   const TreeBranch& branch, const BranchAxis& axis, double& height, double direction) {
    constexpr int kTries = 60;
    for (int i = 0; i < kTries; ++i) {
        // Uneven steps do not meet the rings of a regular mesh again and again.
        const double tried = height + direction * branch.radius * (0.0137 * i + 0.0011 * (i % 3));
        const AxisFrame frame = axis.at(tried);
        for (Section& section : tracer.cut(near, frame.centre, frame.along))
            if (section.closed && section.encloses(frame.centre) &&
                is_clean(surface, section, frame.centre, branch.radius)) {
                height = tried;
                return std::move(section);
            }
    }
    throw InputError(
        fmt::format("no cross-section near {} is star-shaped about the axis of the branch: its bark folds "
                    "back there, or it forks; pick a smoother place",
                    text_of(axis.at(height).centre)));
}

bool above(const TreeSurface& surface, const Section& section, std::int32_t v) {
    return (surface.positions[static_cast<std::size_t>(v)] - section.origin).dot(section.normal) >= 0;
}

std::int32_t vertex_of_side(const TreeSurface& surface, const Section& section, bool of_upper) {
    const SectionPoint& p = section.points[0];
    return above(surface, section, p.low) == of_upper ? p.low : p.high;
}

/// Joins vertices that no cut parts.
DisjointSets parted_sets(const TreeSurface& surface, const BranchCut& cut) {
    DisjointSets sets(surface.positions.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& v = surface.triangles[t].vertices;
        const auto zone = [&](std::int32_t vertex) {
            const int from_low = cut.crossed_low[t] && above(surface, cut.lower, vertex) ? 1 : 0;
            const int from_high = cut.crossed_high[t] && above(surface, cut.upper, vertex) ? 1 : 0;
            return from_low + from_high;
        };
        for (std::size_t k = 0; k < 3; ++k)
            if (zone(v[k]) == zone(v[(k + 1) % 3])) sets.join(v[k], v[(k + 1) % 3]);
    }
    return sets;
}

/// What lies between the cuts must be bark about the axis: a twig that leaves there would be lost.
void check_between(const TreeSurface& surface, const BranchCut& cut, const TreeBranch& branch,
                   const BranchAxis& axis) {
    const double widest = 1.5 * std::max(cut.lower.outer_radius(axis.at(cut.low).centre),
                                         cut.upper.outer_radius(axis.at(cut.high).centre));
    for (std::size_t v = 0; v < cut.sides.size(); ++v) {
        if (cut.sides[v] != TreeSide::Between || surface.component[v] != branch.component) continue;
        const Vec3& p = surface.positions[v];
        const double height = axis.height_of(p);
        const bool is_beside = height > cut.low - branch.radius && height < cut.high + branch.radius;
        if (is_beside && (p - axis.at(height).centre).norm() < widest) continue;
        const double nearest = std::clamp(height, cut.low, cut.high);
        throw InputError(fmt::format(
            "something leaves the branch near {}, {:.3g} from the picked point, within the length "
            "that the break needs ({:.3g} to both sides); pick a point farther from it",
            text_of(axis.at(nearest).centre), std::abs(nearest), 0.5 * (cut.high - cut.low)));
    }
}

}  // namespace

BranchCut cut_branch(const TreeSurface& surface, SectionTracer& tracer, const TreeBranch& branch,
                     const BranchAxis& axis, double low, double high) {
    const auto near =
        triangles_near(surface, branch.component, branch.centre, std::max(-low, high) + 4 * branch.radius);
    BranchCut cut;
    cut.low = low;
    cut.high = high;
    cut.lower = clean_loop(surface, tracer, near, branch, axis, cut.low, -1);
    cut.upper = clean_loop(surface, tracer, near, branch, axis, cut.high, 1);
    cut.crossed_low.assign(surface.triangles.size(), false);
    cut.crossed_high.assign(surface.triangles.size(), false);
    for (const SectionPoint& p : cut.lower.points)
        cut.crossed_low[static_cast<std::size_t>(p.triangle)] = true;
    for (const SectionPoint& p : cut.upper.points)
        cut.crossed_high[static_cast<std::size_t>(p.triangle)] = true;

    DisjointSets sets = parted_sets(surface, cut);
    const std::int32_t tree = sets.find(vertex_of_side(surface, cut.lower, false));
    const std::int32_t piece = sets.find(vertex_of_side(surface, cut.upper, true));
    const std::int32_t between = sets.find(vertex_of_side(surface, cut.lower, true));
    if (tree == piece || tree == between)
        throw InputError(
            fmt::format("cutting the branch at {} would not part the tree: both sides hold together "
                        "elsewhere; pick a branch that ends freely",
                        text_of(branch.point)));
    cut.sides.assign(surface.positions.size(), TreeSide::Between);
    for (std::size_t v = 0; v < cut.sides.size(); ++v) {
        const std::int32_t set = sets.find(static_cast<std::int32_t>(v));
        if (set == tree) cut.sides[v] = TreeSide::Tree;
        if (set == piece) cut.sides[v] = TreeSide::Piece;
    }
    check_between(surface, cut, branch, axis);
    assign_hangers(surface, branch, axis, cut);
    return cut;
}

}  // namespace windfall::fracture
