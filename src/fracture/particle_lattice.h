#pragma once
// The branch as particles (Yang, Yang, Yang 2019, sec. 3.1): discs of rings and sectors around the pith, each
// particle linked to six neighbours: left and right in its ring, above and below in its fibre, inner and
// outer on its ray. The six alone would let cells collapse sideways, so every cell has its faces' diagonals
// too, which give it its shear modulus.
#include <functional>
#include <span>
#include <vector>

#include "fracture/particle_system.h"

namespace windfall::fracture {

/// The particles of one disc: the pith, then ring after ring. Lengths in radii of the branch.
class DiscPlan {
  public:
    DiscPlan(int rings, int sectors);
    int rings() const { return m_rings; }
    int sectors() const { return m_sectors; }
    std::size_t size() const { return m_x.size(); }
    /// Column (a fibre's place in the disc) of a ring, 0 the pith, and a sector, which wraps.
    std::size_t column(int ring, int sector) const;
    double x(std::size_t column) const { return m_x[column]; }
    double y(std::size_t column) const { return m_y[column]; }
    int ring(std::size_t column) const { return m_ring[column]; }
    /// Share of the cross-section; all together pi.
    double area(std::size_t column) const { return m_area[column]; }
    /// The column nearest to a point of the plan.
    std::size_t nearest(double x, double y) const;

    /// A value given at the columns, interpolated at a point; outside of the disc as at its rim.
    double interpolate(const std::vector<double>& values, double x, double y) const;

  private:
    int m_rings, m_sectors;
    std::vector<double> m_x, m_y, m_area;
    std::vector<int> m_ring;
};

/// Moduli over density, that is squares of wave speeds, in radii and seconds.
struct LatticeMaterial {
    double along = 1;         ///< E of the fibres
    double across = 0.1;      ///< E of the links on rings and rays
    double shear = 1.0 / 15;  ///< G of planes along the fibres, and of the disc
};

/// Where the particles of one end of the branch stand in the list of all. Level k of the branch is disc
/// `k - first_level` of the end.
struct LatticeEnd {
    std::size_t first = 0;  ///< its first particle
    int first_level = 0, last_level = 0;
    std::size_t columns = 0;

    std::size_t at(int level, std::size_t column) const {
        return first + static_cast<std::size_t>(level - first_level) * columns + column;
    }
    std::size_t past() const { return at(last_level + 1, 0); }
};

/// How much of a particle's cell is wood of this end, 0 to 1: in its mass (density 1) and in its stiffness.
struct CellShare {
    double mass = 1, stiffness = 1;
};
using Filling = std::function<CellShare(int level, std::size_t column)>;
/// Moves points of the straight branch to where they rest.
using RestShape = std::function<void(std::span<Eigen::Vector3f>)>;

/// Adds the discs `end.first_level` to `end.last_level` of the heights `levels`, with masses and springs. The
/// first disc is held when `clamped`. Sets `end.first` and `end.columns`.
void add_lattice(LatticeEnd& end, const DiscPlan& plan, const std::vector<double>& levels,
                 const LatticeMaterial& material, const Filling& filling, const RestShape& shape,
                 bool clamped, Particles& particles, std::vector<Spring>& springs);

}  // namespace windfall::fracture
