#pragma once
// Drying cracks drawn from statistics (Yang, Yang, Yang 2019, sections 4 and 5), without any lattice, so that
// a log is the same one at any resolution.
#include <cstdint>
#include <vector>

#include "fracture/parameters.h"

namespace windfall::fracture {

/// Classes of cracks, in the order in which they are given their place.
enum class CrackRank : std::uint8_t { Check, Large, Medium, Tangential, Small };

/// One crack. It opens as a tent: widest in the middle of its length (the check: all along), closed at its
/// ends and at its bottom.
struct Crack {
    CrackRank rank = CrackRank::Large;
    std::uint32_t index = 0;    ///< within its class
    double line = 0;            ///< angle of a radial crack, rad, 0 .. 2 pi; radius of a tangential one
    double begin = 0, end = 0;  ///< radii along the ray, or angles along the ring, counter-clockwise
    double depth = 0;           ///< from the cut face where it is deepest, radii
    double half_width = 0;      ///< where it is widest: rad of a radial crack, radii of a tangential one

    bool radial() const { return rank != CrackRank::Tangential; }
    bool narrowed = false;  ///< opens less than was asked

    /// Only of the check, and only in a log: there it opens through the bark.
    bool reaches_bark() const { return rank == CrackRank::Check && end >= 1; }
};

/// How many cracks became what.
struct CrackCount {
    int asked = 0;
    int opened = 0;     ///< asked - dropped
    int shortened = 0;  ///< of the opened ones, because they would have met another one
    int dropped = 0;    ///< for lack of room, or too short for the lattice
    int narrowed = 0;   ///< of the opened ones, because the wood between cracks would have folded over
};

struct CrackSet {
    std::vector<Crack> cracks;
    CrackCount count;
};

/// Room that cracks leave to each other and that the shortest one takes.
struct CrackRoom {
    double along_ray = 0.02;   ///< radii
    double along_ring = 0.02;  ///< radii
    double least_angle = 0;    ///< rad, whatever the radius
};

/// Opening of the big check at the bark, from one wall to the other, rad: what the shrinkage along the rings
/// exceeds that along the rays opens in a full turn, times the share that the check relieves.
double check_opening(const FractureParameters& parameters);

/// Narrows a crack that would open to more than 0.4 of its length, a hole rather than a crack; true if it
/// did.
bool limit_width(Crack& crack);

/// Draws the cracks of a recipe, of sound wood only: no crack but the check reaches the inner bark. Lengths,
/// depths and widths are uniform within a half and one and a half of their mean; neighbours of a class are a
/// gap apart, give or take up to 0.6 of it. No crack but the check opens to more than 0.4 of its length. A
/// crack that would meet one of those before it is shortened to the longest free part of its line; under a
/// quarter of its length it is dropped. Every number of crack k of a class depends on the seed, the class and
/// k alone.
CrackSet draw_cracks(const FractureParameters& parameters, const CrackRoom& room = {});

}  // namespace windfall::fracture
