#pragma once
// Where the points of a cracked log lie.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fracture/crack_lattice.h"
#include "fracture/crack_wander.h"

namespace windfall::fracture {

/// A log of radius 1 under its cut face z = 0: the cross-section's nodes, carried down along the fibres, with
/// open cracks and wandering rays. No cell of the lattice is turned inside out: where one would be, the
/// cracks around it are narrowed, and where there are none the rays wander less.
class CrackShape {
  public:
    /// Cracks stay clear of the log's lower end at -branch.length.
    explicit CrackShape(const FractureParameters& parameters);

    const CrackedSection& section() const { return m_section; }
    const CrackCount& count() const { return m_section.count(); }

    /// Place in plan of a node at height z, -length <= z <= 0; `side` counts only where a crack parts the
    /// node.
    Eigen::Vector2d at(int ring, int sector, double z, CrackSide side) const;

    /// Corners in plan of the cell between rings `ring`, `ring` + 1 and sectors `sector`, `sector` + 1 at
    /// height z: inner and outer at `sector`, outer and inner at the next one. At the pith the first and the
    /// last are the same.
    std::array<Eigen::Vector2d, 4> cell(int ring, int sector, double z) const;

    /// Smallest Jacobian at the corners of a cell, over the area of an undisturbed one: positive where it is
    /// not turned inside out.
    double least_jacobian(int ring, const std::array<Eigen::Vector2d, 4>& corners) const;

    /// Places in plan of all nodes of one height, by CrackGrid::node: a parted node's left side in `left`,
    /// its right side in `right`; in both the same where it is not parted.
    struct Layer {
        std::vector<Eigen::Vector2d> left, right;
    };
    const Layer& cut_face() const { return m_cut_face; }    ///< z = 0
    const Layer& lower_end() const { return m_lower_end; }  ///< z = -length

  private:
    Eigen::Vector2d cracked(int ring, int sector, double z, CrackSide side) const;  // not yet wandering
    using Cells = std::vector<CrackedSection::Cell>;
    Layer layer(double z) const;
    /// The cells of a layer whose least Jacobian lies below the limit.
    Cells pressed_cells(const Layer& layer, double limit) const;
    /// Those of `cells` that fold at the cut face or at some height below it.
    Cells folded_cells(const Cells& cells) const;
    void straighten();
    /// Closes cracks and, at last, stops the rays until nothing folds: without both nothing can.
    void give_up();

    CrackedSection m_section;
    CrackWander m_wander;
    double m_length;
    Layer m_cut_face, m_lower_end;
};

}  // namespace windfall::fracture
