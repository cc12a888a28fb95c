#pragma once
// How the opening of cracks moves the points of a broken surface, in plan.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fracture/crack_lattice.h"
#include "fracture/crack_slit.h"
#include "fracture/crack_wander.h"

namespace windfall::fracture {

/// The displacement of CrackShape at the cut face, for points between the lattice's nodes: continuous but
/// across cracks, one to one, and nothing at the rim.
class CrackMotion {
  public:
    CrackMotion(const FractureParameters& parameters, const CrackedSection& section);

    /// Where a point of the plan goes when the cracks open. Its cell says on which side of them it is;
    /// `left_out`: a crack that is not to move it, because the point lies on its bottom.
    Eigen::Vector2d moved_apart(const Eigen::Vector2d& point, const SurfaceCell& cell,
                                std::optional<std::size_t> left_out = std::nullopt) const;

    /// Lets points wander, which they do last.
    void wander(std::vector<Eigen::Vector2d>& points) const;

    /// Depth of a crack's bottom under its edge at a node, radii.
    static double depth(const LatticeCrack& crack, int node) { return crack.depth[crack.entry(node)]; }

    /// Halves the wandering.
    void calm() { m_wander.calm(); }
    bool stop_wander() { return m_wander.stop(); }

  private:
    CrackShift shift(double radius, double angle, const SurfaceCell& cell,
                     std::optional<std::size_t> left_out) const;

    const CrackedSection& m_section;
    CrackWander m_wander;
};

}  // namespace windfall::fracture
