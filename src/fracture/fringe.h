#pragma once
// What hangs off a break once its ends are apart: bent strands and peeling strips of bark.
#include <cstdint>
#include <vector>

#include "fracture/break_ends.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// A strip of bark that was torn out of the stub: there the broken edge of the bark stands `length` lower.
struct BarkStrip {
    float angle, half_width, length;  ///< rad, rad, radii
    std::uint32_t name;
    bool holds(float at) const;
};

/// The strips of a recipe, each keyed by its number.
std::vector<BarkStrip> bark_strips(const FractureParameters& parameters);

/// How far the ends are apart, for what hangs off them: 0 where the fallen piece still has its place, 1 where
/// it has left it. Strands straighten as it falls to 0.
float release(const FractureParameters& parameters, const BreakEnds& ends);

/// Whether nothing of the piece is left where the fringe of the stub would hang.
bool stand_apart(const FractureParameters& parameters, const BreakEnds& ends);

/// Adds the strips themselves to the stub: closed bodies that are rooted in the bark below their notch and
/// curl outwards, torn into tongues at their ends. They need the room that the fallen piece has left: call it
/// only when the piece is elsewhere. Strips whose notch lies within another one's are left out.
void add_strips(const FractureParameters& parameters, BreakEnds& ends);

}  // namespace windfall::fracture
