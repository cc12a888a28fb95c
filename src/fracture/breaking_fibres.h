#pragma once
// Single fibres that bridge a break while it opens: each is rooted in both ends, is peeled out of the wood as
// far as its bond allows, grows thin and tears, and its halves spring back and curl.
//
// A fibre is a chain of particles. It follows the ends and does not pull on them: it weighs a thousandth.
#include <array>
#include <cstdint>
#include <vector>

#include "fracture/breaking_fibre_roots.h"
#include "fracture/breaking_frames.h"

namespace windfall::fracture {

/// What becomes of it. Nodes [0] of the stub's half, [1] of the piece's.
struct FibreState {
    std::array<std::array<Point, kHalfNodes>, 2> position, velocity;
    std::array<std::array<std::uint8_t, kHalfNodes>, 2> clear;  ///< has been outside of both ends
    std::array<int, 2> freed;  ///< nodes before the tip that are free, the tip included
    double torn_at = -1;       ///< negative while it bridges
};

class BreakingFibres {
  public:
    BreakingFibres(const FractureParameters& parameters, const BreakEnds& ends,
                   const BreakingLattice& lattice);

    /// One step to `time`; `weakening` from 1 to 0 makes the last ones tear, `interlocked` from 1 to 0 tells
    /// how far the splinters still hold each other.
    void advance(const BreakingLattice& lattice, const Particles& particles, const EndFrame& stub,
                 const EndFrame& piece, double step, double time, double weakening, double interlocked);

    const std::vector<BridgingFibre>& fibres() const { return m_fibres; }
    std::size_t bridging() const;
    /// How far a fibre is on its way to tearing, 0 to 1.
    double stretched(std::size_t fibre) const;

    std::vector<FibreState> states;

  private:
    void peel_or_tear(std::size_t fibre, double weakening, double time);
    void relax(std::size_t fibre);
    void follow_ends(std::size_t fibre, const Particles& particles, const EndFrame& stub,
                     const EndFrame& piece, double interlocked);
    void collide(std::size_t fibre, const BreakingLattice& lattice, const EndFrame& stub,
                 const EndFrame& piece);
    void curl(std::size_t fibre, int half, const Point& direction, double share);

    std::vector<BridgingFibre> m_fibres;
};

}  // namespace windfall::fracture
