#pragma once
// Bodies of thorns and strands.
#include <array>
#include <cstdint>

#include "fracture/branch_mesh.h"

namespace windfall::fracture {

/// A slender body over a quadrilateral. The column over the footprint holds all of it.
struct ThornShape {
    std::array<Vector2f, 4> footprint;     ///< counter-clockwise from above
    float root = 0, surface = 0, tip = 0;  ///< z: in the wood, at its surface, at the end; root < surface <
                                           ///< tip on the stub, the other way round on the piece
    std::uint32_t shape = 0;               ///< random bits: lean of the tip, height of the pyramid
    std::uint32_t bundle = 0;
    Tissue tissue = Tissue::Sapwood;
};

/// A hexahedron whose upper 50-80 % taper to an irregular triangular pyramid (Yang et al. 2019, section 4.2).
void add_thorn(const ThornShape& shape, BranchMesh& mesh);

/// A thin fibre of even taper in `segments` pieces. It leaves the wood upright and leans by `bend` at its
/// tip, as the square of the way along it; with no bend the column over the footprint holds all of it.
void add_strand(const ThornShape& shape, int segments, const Vector2f& bend, BranchMesh& mesh);

}  // namespace windfall::fracture
