#pragma once
// Finds the branch at a point of a tree: its axis and radius there, and how it goes on to both sides.
#include <vector>

#include "fracture/tree_section.h"
#include "fracture/tree_surface.h"

namespace windfall::fracture {

/// A branch where it was picked. Lengths are those of the file.
struct TreeBranch {
    geometry::Vec3 point;   ///< of the surface, nearest to the one that was asked for
    geometry::Vec3 centre;  ///< of the cross-section through it
    geometry::Vec3 axis;    ///< unit vector
    double radius = 0;      ///< of a circle as large as the cross-section
    std::int32_t component = 0;
};

/// Triangles of one body in a box.
std::vector<std::int32_t> triangles_near(const TreeSurface& surface, std::int32_t component,
                                         const geometry::Vec3& centre, double half_size);

/// The axis is the direction with the smallest cross-section, then the line through the centroids of
/// neighbouring sections. Throws InputError when `at` is farther from the surface than the branch is thick,
/// or when the surface is open or inside out there.
TreeBranch find_branch(const TreeSurface& surface, SectionTracer& tracer, const geometry::Vec3& at);

/// A cross-section's place: the plane of `across` and `along.cross(across)`.
struct AxisFrame {
    geometry::Vec3 centre, along, across;

    geometry::Vec3 third() const { return along.cross(across); }
    geometry::Vec3 direction(double angle) const;
};

/// The bent axis of a branch: centroids of sections at equal steps, joined by a smooth curve
/// (Catmull and Rom 1974), with frames that do not turn about it (Wang et al. 2008). Height 0 is where the
/// branch was picked.
class BranchAxis {
  public:
    BranchAxis(std::vector<geometry::Vec3> centres, std::size_t zero, double step,
               const geometry::Vec3& across);

    double lowest() const { return -static_cast<double>(m_zero) * m_step; }
    double highest() const { return lowest() + static_cast<double>(m_frames.size() - 1) * m_step; }
    /// Beyond its ends the axis goes on straight.
    AxisFrame at(double height) const;
    /// The height of the plane through `point`.
    double height_of(const geometry::Vec3& point) const;
    /// Largest angle that the axis turns in one step, rad.
    double sharpest_turn() const;
    double step() const { return m_step; }

  private:
    std::vector<AxisFrame> m_frames;
    std::size_t m_zero;
    double m_step;
};

/// Follows the branch `reach` to both sides. Angles count from the side of `up`. Throws InputError when it
/// forks, ends, is open or turns too sharply on the way: where, and where to break it instead.
BranchAxis follow_branch(const TreeSurface& surface, SectionTracer& tracer, const TreeBranch& branch,
                         double reach, const geometry::Vec3& up);

}  // namespace windfall::fracture
