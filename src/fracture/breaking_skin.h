#pragma once
// Detailed surfaces that follow the lattice: every disc carries a frame, and a vertex follows the frames
// about its height, blended by cubic B-splines.
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/breaking_lattice.h"

namespace windfall::fracture {

/// How a disc has moved: x -> centre + turn (x - rest_centre).
struct DiscMotion {
    Eigen::Vector3d rest_centre, centre;
    Eigen::Matrix3d turn;
};

/// The best rigid motion (Horn 1987; by singular values) of each disc of an end with those next to it.
std::vector<DiscMotion> disc_motions(const BreakingLattice& lattice, const LatticeEnd& end,
                                     const Particles& particles);

/// Vertices that follow one end.
class LatticeSkin {
  public:
    /// `unplaced_heights`: z of the vertices in the unplaced branch; `rest`: where they rest.
    LatticeSkin(const BreakingLattice& lattice, const LatticeEnd& end,
                std::span<const float> unplaced_heights, std::vector<Vector3f> rest);

    const std::vector<Vector3f>& rest() const { return m_rest; }
    /// The vertices' places, by the discs of this end; none below `lattice.ground`. With the particles at
    /// rest, the rest to rounding.
    std::vector<Vector3f> positions(const BreakingLattice& lattice,
                                    const std::vector<DiscMotion>& motions) const;

  private:
    std::vector<Vector3f> m_rest;
    std::vector<std::array<std::int32_t, 4>> m_discs;
    std::vector<std::array<float, 4>> m_weights;
};

}  // namespace windfall::fracture
