#pragma once
// Splinters that are still in the other end's hole slide along it and bend, where the rigid turn of their own
// end would take them out through its bark.
#include <cstdint>
#include <vector>

#include "fracture/breaking_skin.h"

namespace windfall::fracture {

/// Height about which the wood of the stub gives way to that of the piece, splinters smoothed out: for each
/// column of the lattice.
std::vector<double> smoothed_heights(const BreakingLattice& lattice);

/// The vertices of one end that reach past the smoothed break into the other end.
class SplinterGuide {
  public:
    /// Of the stub's splinters or of the piece's; `rest`: where the end's vertices rest.
    SplinterGuide(const BreakingLattice& lattice, const BreakEnds& ends, bool of_stub,
                  const std::vector<Vector3f>& rest);

    /// How firmly a hole holds a splinter at a depth below its mouth, 0 to 1.
    static double held(double depth);

    /// Draws the splinters in `positions` back into their holes, and those that would come out through the
    /// other end's bark back under it. `other`: motion of the other end at the break; `share` from 1 (the
    /// ends are interlocked) to 0 (apart).
    void apply(const DiscMotion& other, double share, std::vector<Vector3f>& positions) const;

  private:
    struct Splinter {
        std::size_t vertex;
        float mouth;    ///< height of the hole's mouth in the unplaced branch
        float lowered;  ///< height in the unplaced branch over that at rest
        Vector3f rest;
    };
    float edge_at(float x, float y) const;

    std::vector<Splinter> m_splinters;
    std::vector<float> m_edge;  ///< height of the other end's broken edge of bark, around
    float m_sense;              ///< 1 for the piece, whose splinters reach down; -1 for the stub
};

}  // namespace windfall::fracture
