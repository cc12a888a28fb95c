#include "fracture/tree_break.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/error.h"
#include "fracture/break_ends.h"
#include "fracture/broken_branch.h"
#include "fracture/fringe.h"
#include "fracture/open_cracks.h"
#include "fracture/tree_cut.h"
#include "fracture/tree_part.h"
#include "fracture/tree_text.h"
#include "fracture/tree_wood.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

/// Radii between the cuts and the broken surface.
constexpr double kMargin = 0.3;

/// What of the recipe holds for a branch that has its own size and shape.
FractureParameters for_branch(const FractureParameters& parameters, double diameter_m) {
    FractureParameters result = parameters;
    if (result.fracture.end == EndKind::Cut)
        throw InputError(
            "break.end = \"cut\" makes a sawn log, which has no tree; set break.end = \"broken\"");
    constexpr double kThinnest_m = 1e-4, kThickest_m = 5;  // the range of branch.diameter_m
    if (diameter_m < kThinnest_m)
        throw InputError(fmt::format(
            "the branch is {:.3g} m thin, if a unit of the tree's file is as long as --unit-m says; "
            "give a larger one",
            diameter_m));
    if (diameter_m > kThickest_m)
        throw InputError(fmt::format(
            "the branch is {:.3g} m thick, if the tree's lengths are metres; give the length of its "
            "unit with --unit-m (0.01 for centimetres)",
            diameter_m));
    result.branch.diameter_m = diameter_m;
    result.branch.taper = 0;
    result.branch.bend_deg = 0;
    result.output.motion = Motion::Still;
    check(result);
    return resolved(result);
}

BreakEnds broken_ends(const FractureParameters& parameters) {
    BreakEnds ends;
    BreakWorkspace workspace;
    make_break_ends(parameters, ends, workspace);
    check_heights(parameters, ends.lowest, ends.highest);
    const CrackParameters& c = parameters.cracks;
    if (c.check || c.large.count + c.medium.count + c.small.count + c.tangential.count > 0)
        open_cracks(ends, parameters);
    if (stand_apart(parameters, ends)) add_strips(parameters, ends);
    return ends;
}

/// Bark between the cuts and a little beyond, where rays look for it.
std::vector<std::int32_t> bark_triangles(const TreeSurface& surface, const TreeBranch& branch,
                                         const BranchCut& cut) {
    std::vector<std::int32_t> triangles;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const std::int32_t v = surface.triangles[t].vertices[0];
        if (surface.component[static_cast<std::size_t>(v)] != branch.component) continue;
        bool is_between = cut.crossed_low[t] || cut.crossed_high[t];
        for (const std::int32_t w : surface.triangles[t].vertices)
            is_between = is_between || cut.sides[static_cast<std::size_t>(w)] == TreeSide::Between;
        if (is_between) triangles.push_back(static_cast<std::int32_t>(t));
    }
    return triangles;
}

/// How far the fallen piece is moved: by the gap along the branch, or beside the tree and down to its foot.
Vec3 shift_of(const FractureParameters& parameters, const TreeBranch& branch, const Vec3& up,
              const meshfile::Mesh& tree, const meshfile::Mesh& piece) {
    if (parameters.output.piece != PiecePlace::Beside)
        return parameters.fracture.gap * branch.radius * branch.axis;
    const Vec3 level = branch.axis - branch.axis.dot(up) * up;
    const Vec3 away = level.norm() > 0.1 ? level.normalized() : up.unitOrthogonal();
    const auto lowest = [](const meshfile::Mesh& mesh, const Vec3& direction) {
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& p : mesh.world_positions()) least = std::min(least, p.dot(direction));
        return least;
    };
    const double farthest_of_tree = -lowest(tree, -away);
    return (farthest_of_tree - lowest(piece, away) + branch.radius) * away +
           (lowest(tree, up) - lowest(piece, up)) * up;
}

void tell(const RunContext& context, const char* stage, double done) {
    context.throw_if_cancelled();
    Progress progress;
    progress.stage = stage;
    progress.done = done;
    progress.total = 3;
    context.progress(progress);
}

}  // namespace

TreeBreak break_tree(const meshfile::Mesh& mesh, const Vec3& at, const FractureParameters& parameters,
                     const TreeBreakOptions& options, const RunContext& context) {
    tell(context, "finding the branch", 0);
    const Vec3 up = options.up.normalized();
    const TreeSurface surface = make_tree_surface(mesh);
    SectionTracer tracer(surface);
    TreeBreak result;
    result.branch = find_branch(surface, tracer, at);
    point_to_falling_side(surface, tracer, options, result.branch);
    const TreeBranch& branch = result.branch;

    tell(context, "breaking it", 1);
    const FractureParameters own = for_branch(parameters, 2 * branch.radius * options.unit_m);
    const BreakEnds ends = broken_ends(own);
    const double middle = 0.5 * (ends.lowest + ends.highest);
    const double reach = (0.5 * (ends.highest - ends.lowest) + kMargin) * branch.radius;
    const BranchAxis axis = follow_branch(surface, tracer, branch, reach + branch.radius, up);
    const BranchCut cut = cut_branch(surface, tracer, branch, axis, -reach, reach);

    tell(context, "fitting it into the tree", 2);
    const TreeRays rays(surface, bark_triangles(surface, branch, cut), branch.centre, branch.radius);
    const WoodMap map{axis, rays, branch.radius, middle, cut.low, cut.high};
    const std::vector<EdgeNode> nodes = edge_nodes(ends);
    TreePartPlan plan{mesh, surface, cut, branch, own, {}};
    for (const BranchMesh* end : {&ends.stub, &ends.piece})
        for (const Part part : end->parts) plan.parts[static_cast<std::size_t>(part)] = true;
    const auto part = [&](TreeSide side) {
        const bool is_piece = side == TreeSide::Piece;
        const BranchMesh& end = is_piece ? ends.piece : ends.stub;
        const BranchBark bark =
            make_bark({is_piece ? cut.upper : cut.lower, is_piece ? cut.high : cut.low, is_piece, nodes,
                       end.positions, branch.radius, middle, static_cast<std::size_t>(own.branch.layers)},
                      axis, rays);
        const std::vector<Vec3> places = map.places(end.positions);
        return tree_part(plan, side, bark, {end, places});
    };
    result.tree = part(TreeSide::Tree);
    if (own.output.piece != PiecePlace::Hidden) result.piece = part(TreeSide::Piece);
    result.piece_shift = result.piece.faces.empty() ? Vec3(Vec3::Zero())
                                                    : shift_of(own, branch, up, result.tree, result.piece);
    tell(context, "fitting it into the tree", 3);
    return result;
}

}  // namespace windfall::fracture
