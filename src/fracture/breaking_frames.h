#pragma once
// Where an end of the break is and how it is turned, read off a few of its particles about the break.
#include "fracture/breaking_lattice.h"

namespace windfall::fracture {

/// Axes of the plan and of the fibres, carried along by an end. They are right about the break; far from it
/// an end may be bent a little.
struct EndFrame {
    Point origin = Point::Zero();  ///< of the pith at the height `height` of the unplaced branch
    double height = 0;
    Point x = Point::Zero(), y = Point::Zero(), z = Point::Zero();

    static EndFrame of(const BreakingLattice& lattice, const LatticeEnd& end, const Particles& particles);

    /// Coordinates in the unplaced branch, of which this end is taken to be a part.
    Point unplaced(const Point& where) const {
        const Point arm = where - origin;
        return point(arm.dot(x), arm.dot(y), arm.dot(z) + height);
    }
    /// A direction of the unplaced branch in space.
    Point turned(const Point& direction) const {
        return direction.x() * x + direction.y() * y + direction.z() * z;
    }
};

/// Angle between the fibres of both ends, rad.
double bend_between(const EndFrame& stub, const EndFrame& piece);

/// How deep a point lies within an end, and the nearest way out.
struct Inside {
    double depth = 0;  ///< positive inside, negative outside (about the distance)
    Point way_out = Point::Zero();
};

/// Tests a point against the stub (below the broken surface) or the piece (above it), as a cylinder of
/// radius 1 with the surface's height over the lattice's columns.
Inside inside_stub(const BreakingLattice& lattice, const EndFrame& stub, const Point& where);
Inside inside_piece(const BreakingLattice& lattice, const EndFrame& piece, const Point& where);

}  // namespace windfall::fracture
