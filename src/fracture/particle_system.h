#pragma once
// Position-based dynamics of particles and distance constraints (Müller et al. 2007, Position based dynamics;
// Macklin, Müller, Chentanez 2016, XPBD; with one sweep of the constraints in each of many small steps:
// Macklin et al. 2019, Small steps in physics simulation).
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace windfall::fracture {

/// A point or vector of space; the fourth entry is 0, so that one takes one register.
using Point = Eigen::Vector4d;

inline Point point(double x, double y, double z) { return {x, y, z, 0}; }

/// a x b of the first three entries; the fourth is 0.
inline Point cross(const Point& a, const Point& b) { return a.cross3(b); }

struct Particles {
    std::vector<Point> position, velocity, previous;
    std::vector<double> inverse_mass;  ///< 0: held in place

    std::size_t size() const { return position.size(); }
    void add(const Point& where, double mass);
};

/// A spring between two particles before it is prepared for the solver.
struct Spring {
    std::int32_t a, b;
    double stiffness;  ///< force over elongation
};

/// XPBD distance constraint, C = (|d|^2 - l^2) / (2 l) over d = x_a - x_b: the Green strain times the rest
/// length l, which is the elongation up to second order and needs neither root nor division.
struct DistanceConstraint {
    std::int32_t a, b;
    double inverse_rest_sq;   ///< 1 / l^2
    double share_a, share_b;  ///< w / (w_a + w_b + compliance / step^2), w the inverse masses
};

/// Constraints with the particles' present distances as rest lengths, for steps of `step`. Springs between
/// two held particles are dropped.
std::vector<DistanceConstraint> prepare(const std::vector<Spring>& springs, const Particles& particles,
                                        double step);

/// Velocities and positions of one step without constraints: x <- x + step v, v <- v + step gravity.
void predict(Particles& particles, const Point& gravity, double step);

/// One Gauss-Seidel sweep in the order of the list. Sums of momentum and angular momentum stay.
void project(const std::vector<DistanceConstraint>& constraints, Particles& particles);

/// Velocities from the way of this step.
void update_velocities(Particles& particles, double step);

/// Motion of a group of particles as a whole.
struct RigidMotion {
    double mass = 0;
    Point centre = Point::Zero(), velocity = Point::Zero(), spin = Point::Zero();

    /// Of particles [begin, end), all of which are free.
    static RigidMotion of(const Particles& particles, std::size_t begin, std::size_t end);
    Point at(const Point& where) const { return velocity + cross(spin, where - centre); }
};

/// Takes `share` of the velocities relative to the rigid motion of the free particles [begin, end), whose
/// momentum and angular momentum stay (Müller et al. 2007, sec. 3.5).
void damp_relative(Particles& particles, std::size_t begin, std::size_t end, double share);

}  // namespace windfall::fracture
