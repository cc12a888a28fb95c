#pragma once
// The fibres across the broken surface, while they hold: one bond for each column of the lattice, between the
// stub's and the piece's particle where its fibre link crosses the surface.
//
// A bond is elastic; pulled beyond its limit it slides out against a friction that fades, until it is torn
// (cohesive zone: Dugdale, Barenblatt; linear softening). Pressed it yields, as wood does along the grain,
// and stands firm again when it is crushed. A bond on the compression side, the hinge, lets go when it is
// bent too sharply.
#include <vector>

#include "fracture/bending.h"
#include "fracture/breaking_lattice.h"

namespace windfall::fracture {

/// What holds one column. Lengths in radii.
struct BondStrength {
    double elastic = 0;   ///< elongation where it begins to slide
    double crushing = 0;  ///< shortening where it begins to yield
    double pull_out = 0;  ///< sliding way at which it is torn
    double bend = 0;      ///< angle between both ends at which it is torn, rad
};

/// Keyed by (seed, column): of two woods that differ in one parameter the same bonds are the strong ones.
/// Wet wood bears more strain and slides farther; fibres on the crushed side break short.
std::vector<BondStrength> bond_strengths(const FractureParameters& parameters,
                                         const BreakingLattice& lattice);

/// The bonds of a break; `slip` and `torn_at` are all of their state.
class BreakingBonds {
  public:
    BreakingBonds(const FractureParameters& parameters, const BreakingLattice& lattice);

    /// Pulls the particles of the bonds that hold together, one sweep.
    void project(Particles& particles) const;

    /// Slides, crushes and tears at the positions reached. `bend`: angle between the ends, rad; `weakening`:
    /// factor on pull_out and bend, 1 at first.
    void yield(const Particles& particles, double bend, double weakening, double time);

    std::size_t size() const { return m_bonds.size(); }
    std::size_t holding() const { return m_holding; }
    bool holds(std::size_t column) const { return torn_at[column] < 0; }
    const BondStrength& strength(std::size_t column) const { return m_bonds[column].strength; }
    /// Counts the bonds that hold, after `torn_at` was set from outside.
    void recount();

    std::vector<double> slip;     ///< plastic elongation (positive) or crushing of each bond
    std::vector<double> torn_at;  ///< time, or negative while it holds

  private:
    struct Bond {
        std::size_t stub, piece, below, above;  ///< the last two tell the fibre's direction in the stub
        double share_stub, share_piece;
        BondStrength strength;
    };
    Point axis(const Bond& bond, const Particles& particles) const;

    std::vector<Bond> m_bonds;
    std::size_t m_holding = 0;
};

}  // namespace windfall::fracture
