#include "fracture/broken_branch.h"

#include "fracture/bark_walls.h"
#include "fracture/bending.h"
#include "fracture/cracked_log.h"
#include "fracture/fringe.h"
#include "fracture/open_cracks.h"
#include "fracture/placing.h"
#include "fracture/species.h"
#include "fracture/wood_colour.h"

namespace windfall::fracture {
namespace {

bool has_cracks(const CrackParameters& c) {
    return c.check || c.large.count + c.medium.count + c.small.count + c.tangential.count > 0;
}

void finish(const FractureParameters& parameters, BreakEnds& ends) {
    if (parameters.fracture.end == EndKind::Cut)
        place_log(parameters, ends.stub);
    else
        place_ends(parameters, ends);
    compute_normals(ends.stub);
    if (ends.piece.positions.empty()) return;
    const bool upside_down = parameters.output.piece == PiecePlace::Beside;
    compute_reverse_normals(ends.stub, static_cast<std::size_t>(ends.surface_vertices), ends.surface_faces,
                            upside_down ? Vector3f(1, -1, -1) : Vector3f(1, 1, 1), ends.piece);
}

}  // namespace

FractureParameters resolved(const FractureParameters& parameters) {
    FractureParameters result = with_load(parameters);
    if (result.fracture.height_from == HeightSource::Species) {
        result.fracture.mean_height = asked_mean_height(result, nullptr);
        result.fracture.height_from = HeightSource::Asked;
    }
    return result;
}

CrackCount make_unplaced(const FractureParameters& parameters, BreakEnds& ends, BreakWorkspace& workspace) {
    if (parameters.fracture.end == EndKind::Cut) {
        ends = BreakEnds{};
        CrackedLog log = make_cracked_log(parameters);
        ends.stub = std::move(log.mesh);
        return log.cracks;
    }
    make_break_ends(parameters, ends, workspace);
    check_heights(parameters, ends.lowest, ends.highest);
    CrackCount cracks;
    if (has_cracks(parameters.cracks)) cracks = open_cracks(ends, parameters);
    if (stand_apart(parameters, ends)) add_strips(parameters, ends);
    add_bark_walls(parameters, ends);
    return cracks;
}

void make_branch(const FractureParameters& parameters, BreakEnds& ends, BreakWorkspace& workspace) {
    make_unplaced(parameters, ends, workspace);
    finish(parameters, ends);
}

void check_surface(const FractureParameters& parameters) {
    if (parameters.fracture.end == EndKind::Cut) return;
    BreakEnds ends;
    BreakWorkspace workspace;
    make_break_ends(resolved(parameters), ends, workspace);
    check_heights(parameters, ends.lowest, ends.highest);
}

BrokenBranch broken_branch(const FractureParameters& parameters) {
    check(parameters);
    const FractureParameters p = resolved(parameters);
    BrokenBranch branch;
    BreakWorkspace workspace;
    branch.cracks = make_unplaced(p, branch.ends, workspace);
    branch.stub_colours = vertex_colours(branch.ends.stub, p);
    branch.piece_colours = vertex_colours(branch.ends.piece, p);
    finish(p, branch.ends);
    if (branch.ends.piece.positions.empty()) branch.piece_colours.clear();
    return branch;
}

}  // namespace windfall::fracture
