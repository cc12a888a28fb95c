#pragma once
// Which single fibres bridge a break, and how they are rooted in both ends.
#include <array>
#include <cstdint>
#include <vector>

#include "fracture/breaking_frames.h"
#include "fracture/breaking_lattice.h"

namespace windfall::fracture {

/// Nodes of one half, from the root (deep in its end) to the tip, where the fibre will tear.
inline constexpr int kHalfNodes = 9;

/// A point of the branch, carried along by eight particles of one end.
struct LatticePoint {
    std::array<std::int32_t, 8> particles;
    std::array<double, 8> weights;

    static LatticePoint in(const BreakingLattice& lattice, const LatticeEnd& end, const Point& unplaced);
    Point at(const Particles& particles_now) const;
};

/// What a fibre is; it does not change.
struct BridgingFibre {
    std::uint32_t name;             ///< its random bits
    Point surface;                  ///< where it crosses the broken surface, in the unplaced branch
    std::array<double, 2> length;   ///< in the stub and in the piece, radii
    std::array<int, 2> most_freed;  ///< nodes that can be peeled out of each end, of 1 .. kHalfNodes - 1
    double radius;                  ///< thickness at the roots
    double tearing;                 ///< strain of the free part at which it tears
    double mouth;                   ///< smoothed height of the break there
    std::array<Point, 2> channel;   ///< its hole in the plan of each end, as EndFrame sees it
    Point curl;                     ///< bend of a torn half from segment to segment, in the unplaced branch
    std::array<std::array<LatticePoint, kHalfNodes>, 2> tied;
};

/// fringe.strands / 6 and a few more, keyed by their number: most of them bast on the tension side.
std::vector<BridgingFibre> bridging_fibres(const FractureParameters& parameters, const BreakEnds& ends,
                                           const BreakingLattice& lattice);

}  // namespace windfall::fracture
