#pragma once
// The flesh as Kider, Raja and Badler print it (Fruit Senescence and Decay Simulation, Eurographics 2011,
// section 4): every edge of the tetrahedra is a spring with point masses at its ends, stepped by fourth-order
// Runge-Kutta. A reference for small, soft fruit, not a way to make pictures: it is stable only for steps
// below `critical_step_s`, a fraction of a millisecond for firm flesh, and springs alone neither keep the
// volume nor keep tetrahedra from turning inside out.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "decay/tetrahedra.h"

namespace windfall::decay {

struct SpringSettings {
    double density_kg_m3 = 1000;
    double modulus_pa =
        20e3;  ///< of the isotropic solid that the springs stand for; its Poisson's ratio is 1/4
    double damping_1_s = 20;  ///< velocity lost, over velocity and time
    double table_pa_m = 3e7;  ///< stiffness of the table z = 0
    double gravity_m_s2 = 9.81;
};

class SpringNetwork {
  public:
    SpringNetwork(const FleshMesh& mesh, const SpringSettings& settings);

    /// The paper's L <- L (1 - x)^(1/3), with x the fraction of the fresh volume lost as water, and its Ks <-
    /// Ks (1 - softening); both from the fresh values.
    void set_loss(double water_fraction_lost, double softening);

    /// Longest stable step (s): 2 sqrt 2 over the highest natural frequency, which a power iteration on the
    /// stiffness at hand finds, contacts included.
    double critical_step_s() const;

    /// One Runge-Kutta step.
    void step(double dt_s);

    const std::vector<geometry::Vec3>& positions() const { return m_positions; }
    const std::vector<geometry::Vec3>& velocities() const { return m_velocities; }
    double kinetic_j() const;

  private:
    using Points = std::vector<geometry::Vec3>;
    void accelerations(const Points& x, const Points& v, Points& a) const;

    SpringSettings m_settings;
    std::vector<std::array<std::int32_t, 2>> m_edges;
    std::vector<double> m_fresh_length_m, m_fresh_stiffness;
    std::vector<double> m_length_m, m_stiffness;
    std::vector<double> m_mass_kg, m_surface_area_m2;
    Points m_positions, m_velocities;
};

}  // namespace windfall::decay
