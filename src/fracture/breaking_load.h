#pragma once
// What breaks the branch: something pushes the top of the piece over, away from the tension side, and does
// not hold it back when it falls by itself.
#include "fracture/bending.h"
#include "fracture/breaking_lattice.h"

namespace windfall::fracture {

/// Pushes the upper fifth of the piece sideways along an arc about the compression side of the break, and
/// twists it with load.twist times the bending moment.
class BreakingLoad {
  public:
    /// `seconds`: when the push reaches its end; it starts at 0, slowly.
    BreakingLoad(const FractureParameters& parameters, const BreakingLattice& lattice, double seconds);

    double seconds() const { return m_seconds; }

    /// Angle (rad) about the compression side to which the piece is pushed at that time, 0 at first.
    double target(double time) const;
    /// Angle (rad) to which the piece has turned.
    double angle(const Particles& particles) const;

    /// Moves the pushed particles towards the target, if they have not passed it; notes the moment.
    void project(Particles& particles, double time, double step);
    /// Twists: velocities of the pushed particles, by the moment of the step before.
    void twist(Particles& particles, double step) const;

    double moment = 0;  ///< of the push, smoothed over time: all of its state

  private:
    Point centre(const Particles& particles) const;

    std::size_t m_begin, m_end;  ///< the pushed particles
    std::size_t m_root;          ///< the pith at the broken end of the piece
    double m_mass = 0, m_inertia = 0;
    Point m_hinge, m_fall;  ///< where the piece turns about, and in which direction it is to fall
    double m_rest_angle = 0;
    double m_seconds, m_twist;
};

}  // namespace windfall::fracture
