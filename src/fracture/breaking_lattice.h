#pragma once
// Both ends of a break as one lattice of particles, as it stands before it breaks.
//
// Each end has discs of its own wherever it has wood, so that in the zone where splinters of both ends reach
// past each other there are two discs at one height. They are not linked there but by the bonds across the
// broken surface (breaking_bonds.h); so the ends come apart cleanly.
#include <vector>

#include "fracture/break_ends.h"
#include "fracture/parameters.h"
#include "fracture/particle_lattice.h"

namespace windfall::fracture {

/// Lengths in radii of the branch, times in seconds, density 1.
struct BreakingLattice {
    DiscPlan plan{4, 16};
    std::vector<double> levels;   ///< heights of the discs in the unplaced branch, rising
    std::vector<double> heights;  ///< of the broken surface, for each column of the plan
    LatticeEnd stub, piece;
    Particles particles;  ///< at rest
    std::vector<DistanceConstraint> constraints;
    double ground = 0;  ///< height of the stub's foot
    double gravity = 0;
    double wave_speed = 0;  ///< along the fibres; its square is the modulus over the density
    double spacing = 0;     ///< smallest distance between discs
    double step = 0;
    int steps = 0;  ///< of `step`, from the start to the end of the take

    /// Whether the wood at this place belongs to the end, not to the other one.
    bool stub_holds(int level, std::size_t column) const {
        return levels[static_cast<std::size_t>(level)] <= heights[column];
    }
    bool piece_holds(int level, std::size_t column) const { return !stub_holds(level, column); }
};

/// `ends`: closed, unplaced, gap 0. `shape` moves points of the unplaced branch to where they rest.
///
/// Real wood is so stiff that the branch would need a million steps a second. The modulus is set as low as
/// the motion allows: the branch bears its piece sideways several times over, whatever its size.
BreakingLattice make_breaking_lattice(const FractureParameters& parameters, const BreakEnds& ends,
                                      const RestShape& shape);

}  // namespace windfall::fracture
