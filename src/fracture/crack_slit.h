#pragma once
// Slits in the surface of a break: paths of edges whose vertices are doubled.
#include <cstdint>
#include <vector>

#include "fracture/break_ends.h"
#include "fracture/crack_lattice.h"

namespace windfall::fracture {

/// A vertex of the broken surface on a crack. Of those that the crack parts, `left` is the one that was
/// there.
struct SlitVertex {
    std::int32_t left, right;
    std::int32_t bottom;  ///< of the crack, in the wood; where the crack closes all three are the same
    int node;             ///< of the lattice, along the crack
};

/// The way of one crack through the surface, from end to end.
using Slit = std::vector<SlitVertex>;

/// A cell of the lattice.
struct SurfaceCell {
    int ring, sector;
};

/// Slits both ends along all cracks of the section. New vertices, all of them places of old ones still,
/// follow those of the surface: first the right sides, which count as vertices of the surface, then the
/// bottoms.
std::vector<Slit> slit_ends(const CrackedSection& section, BreakEnds& ends);

/// For each vertex of the surface and of the bottoms (`count`), a cell that has it for its corner, on its
/// side of every crack.
std::vector<SurfaceCell> cells_of_vertices(const CrackedSection& section, const CellCorners& cells,
                                           const std::vector<Slit>& slits, std::size_t count);

}  // namespace windfall::fracture
