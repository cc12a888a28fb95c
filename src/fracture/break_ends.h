#pragma once
// Both ends of a break: the surface that they share, thorns and the holes that answer them.
#include <cstdint>
#include <memory>
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// The cells of the polar lattice over the cross-section: cell (R, S) lies between rings R and R + 1 and
/// sectors S and S + 1 (wrapping). Its corners, as vertices of the stub (and, with the same numbers, of the
/// piece): 0 inner at S, 1 outer at S, 2 outer at S + 1, 3 inner at S + 1. In the innermost ring 0 and 3 are
/// the pith's vertex.
struct CellCorners {
    int rings = 0, sectors = 0;
    std::vector<std::array<std::int32_t, 4>> corners;  ///< rings * sectors

    const std::array<std::int32_t, 4>& of(int ring, int sector) const {
        return corners[static_cast<std::size_t>(ring) * static_cast<std::size_t>(sectors) +
                       static_cast<std::size_t>(sector)];
    }
};

/// A vertex of the broken edge where bark begins, in order of the angle, counter-clockwise from above. Where
/// fibre bundles end beside each other two of them follow at one angle.
struct RimVertex {
    std::int32_t vertex;
    float angle;  ///< rad, rising; the first may lie a little below 0, by the jitter of the nodes
};

/// Both ends in the unplaced branch with gap 0, without bark and cut ends: each mesh is an open disc (and its
/// thorns, which are closed) whose border is the rim.
struct BreakEnds {
    BranchMesh stub, piece;
    CellCorners cells;
    std::vector<RimVertex> rim;         ///< the same vertices in both ends
    std::int32_t surface_vertices = 0;  ///< the first ones of both meshes lie on the broken surface
    std::size_t surface_faces = 0;      ///< and so do the first faces
    double lowest = 0, highest = 0;     ///< z of the broken surface, holes included
    double mean_height = 0;  ///< mean over the cross-section of z above the lowest point, holes left out
    int stub_thorns = 0, piece_thorns = 0;
};

/// Memory that is kept from one break to the next, so that a slider does not wait for the allocator.
class BreakWorkspace {
  public:
    BreakWorkspace();
    ~BreakWorkspace();
    BreakWorkspace(const BreakWorkspace&) = delete;
    BreakWorkspace& operator=(const BreakWorkspace&) = delete;
    BreakWorkspace(BreakWorkspace&&) noexcept;
    BreakWorkspace& operator=(BreakWorkspace&&) noexcept;
    struct Buffers;
    Buffers& buffers() { return *m_buffers; }

  private:
    std::unique_ptr<Buffers> m_buffers;
};

/// Makes both ends; `parameters` must have passed `check`. The result depends on them alone. Throws
/// InputError when a flat surface is to be scaled to a height.
void make_break_ends(const FractureParameters& parameters, BreakEnds& ends, BreakWorkspace& workspace);

}  // namespace windfall::fracture
