#include "fracture/breaking_frames.h"

#include <algorithm>
#include <cmath>

namespace windfall::fracture {

namespace {

/// The depth below a face of the end, `up` its outward way along the fibres, against that below the bark.
Inside nearer(const EndFrame& frame, const Point& local, double below_face, double up, double past_cut_end) {
    const double radius = std::hypot(local.x(), local.y());
    const double below_bark = 1 - radius;
    Inside result;
    if (below_bark < below_face && radius > 1e-9) {
        result.depth = below_bark;
        result.way_out = frame.turned(point(local.x() / radius, local.y() / radius, 0));
    } else {
        result.depth = below_face;
        result.way_out = frame.turned(point(0, 0, up));
    }
    result.depth = std::min(result.depth, past_cut_end);
    return result;
}

}  // namespace

EndFrame EndFrame::of(const BreakingLattice& lattice, const LatticeEnd& end, const Particles& particles) {
    // Discs near the break that hold wood of this end, about a radius apart.
    const bool is_stub = end.first_level == 0;
    const int near = is_stub ? lattice.piece.first_level : lattice.stub.last_level;
    int far = near;
    const auto level_height = [&lattice](int level) {
        return lattice.levels[static_cast<std::size_t>(level)];
    };
    const int towards = is_stub ? -1 : 1;
    while (far + towards >= end.first_level && far + towards <= end.last_level &&
           std::abs(level_height(far) - level_height(near)) < 1)
        far += towards;
    const auto at = [&](int level, std::size_t column) { return particles.position[end.at(level, column)]; };
    EndFrame frame;
    frame.origin = at(near, 0);
    frame.height = level_height(near);
    frame.z = (at(std::max(near, far), 0) - at(std::min(near, far), 0)).normalized();
    const DiscPlan& plan = lattice.plan;
    const std::size_t right = plan.column(plan.rings(), 0);
    const std::size_t left = plan.column(plan.rings(), plan.sectors() / 2);
    const Point across = at(near, right) - at(near, left) + at(far, right) - at(far, left);
    frame.x = (across - across.dot(frame.z) * frame.z).normalized();
    frame.y = cross(frame.z, frame.x);
    return frame;
}

double bend_between(const EndFrame& stub, const EndFrame& piece) {
    return std::acos(std::clamp(stub.z.dot(piece.z), -1.0, 1.0));
}

Inside inside_stub(const BreakingLattice& lattice, const EndFrame& stub, const Point& where) {
    const Point local = stub.unplaced(where);
    const double surface = lattice.plan.interpolate(lattice.heights, local.x(), local.y());
    return nearer(stub, local, surface - local.z(), 1, local.z() - lattice.levels.front());
}

Inside inside_piece(const BreakingLattice& lattice, const EndFrame& piece, const Point& where) {
    const Point local = piece.unplaced(where);
    const double surface = lattice.plan.interpolate(lattice.heights, local.x(), local.y());
    return nearer(piece, local, local.z() - surface, -1, lattice.levels.back() - local.z());
}

}  // namespace windfall::fracture
