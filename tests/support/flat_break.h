#pragma once
// The parameters of a smooth flat break without anything, to which a test adds what it looks at.
#include <cstdint>

#include "fracture/break_ends.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

inline FractureParameters flat(std::int64_t rings, std::int64_t sectors) {
    FractureParameters p;
    p.branch.rings = rings;
    p.branch.sectors = sectors;
    p.branch.layers = 4;
    p.tissue = {0, 1, 0};
    p.roughness.phloem = p.roughness.sapwood = p.roughness.heartwood = 0;
    return p;
}

inline BreakEnds ends_of(const FractureParameters& p) {
    BreakEnds ends;
    BreakWorkspace workspace;
    make_break_ends(p, ends, workspace);
    return ends;
}

}  // namespace windfall::fracture
