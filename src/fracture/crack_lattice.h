#pragma once
// Cracks on the lines of a polar lattice: which nodes they part, and how far apart.
#include <cstdint>
#include <span>
#include <vector>

#include "fracture/crack_set.h"

namespace windfall::fracture {

/// The lattice's nodes over the cross-section: rings 0 (the pith, one point) .. rings, sectors 0 .. sectors
/// - 1.
struct CrackGrid {
    int rings = 0, sectors = 0;
    int wood_rings = 0;  ///< the ring where wood ends and inner bark begins, 1 .. rings - 1
    std::size_t node(int ring, int sector) const {
        return static_cast<std::size_t>(ring) * static_cast<std::size_t>(sectors) +
               static_cast<std::size_t>(sector);
    }
    int wrapped_sector(int sector) const {
        const int rest = sector % sectors;
        return rest < 0 ? rest + sectors : rest;
    }
    double sector_angle() const;  ///< rad
};

CrackGrid crack_grid(const FractureParameters& parameters);

/// Room by which cracks stay two nodes apart once they lie on the lines of the lattice.
CrackRoom crack_room(const CrackGrid& grid);

/// A crack on a line of the lattice. The nodes strictly between `begin` and `end` are parted; those two are
/// where it closes.
struct LatticeCrack {
    Crack crack;
    int line = 0;                 ///< sector of a radial crack, ring of a tangential one
    int begin = 0, end = 0;       ///< rings, or sectors counted on past the last; the check ends at rings + 1
    std::vector<double> opening;  ///< at nodes begin .. end: half opening at the cut face, rad or radii
    std::vector<double> depth;    ///< at nodes begin .. end: of its bottom under the cut face, radii
    double reach = 0;             ///< distance at which wood no longer gives way: rad or radii

    /// The last node that it has: `end`, or the one at the bark.
    int last_node() const { return crack.reaches_bark() ? end - 1 : end; }
    /// Entry of `opening` and `depth` for the node `along` it (a ring, or a sector, begin .. end).
    std::size_t entry(int along) const { return static_cast<std::size_t>(along - begin); }
    /// The share of the opening by which a node `distance` off the line gives way.
    double share_at(double distance) const { return distance < reach ? 1 - distance / reach : 0; }
};

/// Where a node goes when cracks open: by an angle, rad, and along its ray, radii.
struct CrackShift {
    double angle = 0, radius = 0;
};

/// The side of a parted node, seen along its crack (outwards along a ray, counter-clockwise along a ring).
enum class CrackSide : std::int8_t { Right = -1, Left = 1 };

/// A cross-section with its cracks. Openings do not depend on the resolution: they are tents in angle and
/// radius, narrowed where the lattice's cells would be pressed to less than 0.4 of their width.
class CrackedSection {
  public:
    /// `set` must have been drawn with the room of the grid. No crack goes deeper than `deepest` radii.
    CrackedSection(const FractureParameters& parameters, const CrackGrid& grid, const CrackSet& set,
                   double deepest);

    const CrackGrid& grid() const { return m_grid; }
    const std::vector<LatticeCrack>& cracks() const { return m_cracks; }
    const CrackCount& count() const { return m_count; }

    /// Index of the crack that parts the node; -1: none.
    int owner(int ring, int sector) const { return m_owner[m_grid.node(ring, sector)]; }
    /// The side of the node (ring, sector) that cell (cell_ring, cell_sector) has for its corner; Left where
    /// the node is not parted.
    CrackSide side_of_corner(int ring, int sector, int cell_ring, int cell_sector) const;

    /// Indices of the cracks that move points in or near a sector, some of them perhaps by nothing.
    std::span<const std::uint32_t> moving(int sector) const {
        const auto s = static_cast<std::size_t>(sector);
        return {m_in_sector.data() + m_sector_first[s], m_in_sector.data() + m_sector_first[s + 1]};
    }

    /// Shift of a node at height z <= 0 under the cut face; `side` counts only where the node is parted.
    CrackShift shift(int ring, int sector, double z, CrackSide side) const;

    struct Cell {
        int ring, sector;
    };
    /// Halves, once, the opening of every crack that moves one of the cells; false if there was none.
    bool narrow_around(const std::vector<Cell>& cells);
    /// The last resort: closes every open crack that moves one of the cells, which counts it as dropped;
    /// false if there was none.
    bool close_around(const std::vector<Cell>& cells);

  private:
    double crookedness(double radius, double z) const;
    void snap(const CrackSet& set, double deepest);
    bool lay_on_lattice(const Crack& crack, double deepest, LatticeCrack& result) const;
    void claim_nodes();
    void list_by_sector();
    void limit_openings();
    bool moves_cell(const LatticeCrack& crack, const Cell& cell) const;
    void scale(LatticeCrack& crack, double factor);

    CrackGrid m_grid;
    std::uint32_t m_seed;
    std::vector<LatticeCrack> m_cracks;
    std::vector<std::int32_t> m_owner;          // by node
    std::vector<std::uint32_t> m_sector_first;  // into m_in_sector
    std::vector<std::uint32_t> m_in_sector;
    CrackCount m_count;
};

}  // namespace windfall::fracture
