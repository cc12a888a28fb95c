#pragma once
// From the straight cylinder of radius 1 to the branch in space.
#include <span>

#include "fracture/bark_relief.h"
#include "fracture/break_ends.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// The shape of a limb: irregular outline, bark relief, taper and bend, one after the other. Each keeps the
/// points of space apart (as `check` makes sure), so that two ends that fit still fit.
class LimbShape {
  public:
    /// `lowest` and `highest`: z of the broken surface, between which there is no taper, so that the ends can
    /// be drawn apart without rubbing as a wedge does, and the furrows of the bark run straight, so that no
    /// tooth of the broken edge is folded by them. There they leave alone the wood where thorns stand, which
    /// would be moved out of their holes, and are as shallow as the bark outside of it demands.
    LimbShape(const FractureParameters& parameters, double lowest, double highest);

    /// Moves points of the unplaced branch to where they lie.
    void apply(std::span<Vector3f> points) const;
    /// The same for all vertices of both ends.
    void apply(BreakEnds& ends) const;

  private:
    struct Block;
    void apply(Block& block) const;
    void scale_plan(std::span<Vector3f> points) const;
    void bend(std::span<Vector3f> points) const;

    /// How deep furrows are at the bark, and the width of bark in which they fade inwards.
    struct Furrows {
        float depth, width;
    };
    static Furrows furrows_at_break(const FractureParameters& parameters);
    static Furrows furrows_away(const FractureParameters& parameters);

    std::uint32_t m_outline_seed;
    BarkRelief m_bark;  // of depth 1
    Furrows m_at_break, m_away;
    float m_outline, m_taper, m_curvature;
    float m_lowest, m_highest;
};

/// Puts both ends into their places: shape, gap, and the fallen piece above the stub, beside it (upside down,
/// its broken end up, on the same ground) or nowhere (then it has no vertices). Normals must be computed
/// after.
void place_ends(const FractureParameters& parameters, BreakEnds& ends);

/// The same for a log with one cut end and no fallen piece.
void place_log(const FractureParameters& parameters, BranchMesh& log);

}  // namespace windfall::fracture
