#pragma once
// The ground under the stub, and the two ends against each other.
#include <cstdint>
#include <vector>

#include "fracture/breaking_frames.h"
#include "fracture/breaking_lattice.h"

namespace windfall::fracture {

/// Keeps the piece's wood above the ground, with friction.
class GroundContact {
  public:
    explicit GroundContact(const BreakingLattice& lattice);

    /// Lifts particles from below the ground; rubs along it.
    void project(Particles& particles);
    /// How many particles touched in this step.
    std::size_t touching() const { return m_touching; }
    /// The particles that are kept above the ground: all of the piece's wood.
    const std::vector<std::size_t>& particles() const { return m_wood; }

  private:
    std::vector<std::size_t> m_wood;
    std::size_t m_touching = 0;
    double m_ground;
};

/// Keeps the outside and the broken surface of each end out of the other one. While the ends are still
/// interlocked their splinters pass through each other: a particle takes part from the moment at which it has
/// first been clear of the other end.
class EndContact {
  public:
    explicit EndContact(const BreakingLattice& lattice);

    void project(const BreakingLattice& lattice, const EndFrame& stub, const EndFrame& piece,
                 Particles& particles);

    std::vector<std::uint8_t> clear;  ///< of each point, whether it has been clear: all of the state

  private:
    void push(std::size_t own, std::size_t other, const Inside& inside, Particles& particles) const;

    std::vector<std::size_t> m_stub_points, m_piece_points;  ///< `clear` has both, one after the other
    double m_slow_way;
};

}  // namespace windfall::fracture
