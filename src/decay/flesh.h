#pragma once
// Energy of the flesh: co-rotated linear elasticity about a rest shape that shrinks, weight, contact, and a
// pull to where it was a frame ago.
//
//   E = sum_e V theta [ mu |F - theta R|^2 + lambda / 2 (tr(R^T F) - 3 theta)^2 ]        elements
//     + sum_i m g z + 3 m / 2 |x - x_prev|^2                                              weight, damping
//     + sum_c k_c A / 2 min(gap, 0)^2 + mu_f N_prev ( sqrt(t^2 + eps^2) - eps )            contact, friction
//
// with t the tangential part of x - x_prev and N_prev the contact's force a frame ago: Coulomb's law, made
// smooth over eps. R is the rotation nearest to F (Mueller, Bender, Chentanez, Macklin 2016, A Robust Method
// to Extract the Rotational Part of Deformations, doi:10.1145/2994258.2994269), warm from the evaluation
// before. E is stationary in R, so that its gradient needs no derivative of R.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/aligned_array.h"
#include "decay/body_ground.h"
#include "decay/tetrahedra.h"

namespace windfall::decay {

/// Numbers of the energy above that are the same for every fruit.
struct FleshConstants {
    double poisson = 0.45;
    /// Stiffness of contacts; a tomato's own weight presses it 0.1 mm into the table.
    double contact_pa_m = 3e7;
    double friction = 0.5;  ///< Coulomb's coefficient
    double slip_m = 20e-6;  ///< motion in a frame over which friction comes up
    double damping_s2 = 3;  ///< pull to the last frame over mass, 1/s^2
    double gravity_m_s2 = 9.81;
};

/// Single precision runs; double precision is the twin that tests differentiate.
template <class Real>
class FleshEnergy {
  public:
    using Vec = Eigen::Matrix<Real, 4, 1>;  ///< x, y, z and a zero
    static constexpr int kLanes = 32 / sizeof(Real);

    FleshEnergy(const FleshMesh& mesh, double density_kg_m3);

    std::size_t node_count() const { return m_mass.size(); }
    std::size_t surface_count() const { return m_surface_area.size(); }
    std::size_t element_count() const { return m_tetrahedra.size(); }

    /// Young's modulus and length ratio theta of every element.
    void set_material(const std::vector<double>& modulus_pa, const std::vector<double>& theta);
    /// Share of the fresh mass that is left.
    void set_mass_ratio(double ratio) { m_mass_ratio = static_cast<Real>(ratio); }
    void set_gravity(double m_s2) { m_gravity = static_cast<Real>(m_s2); }
    /// Replaces FleshConstants::damping_s2: a body that nothing holds falls by gravity / damping a frame.
    void set_damping(double per_s2) { m_constants.damping_s2 = per_s2; }
    /// Planes per surface node: the ground's and the nearest neighbour's (empty: none).
    void set_planes(std::vector<ContactPlane> ground, std::vector<ContactPlane> neighbour);
    /// `positions` become where the flesh was a frame ago: what damping and friction pull to.
    void begin_frame(const std::vector<Vec>& positions);

    /// Energy (J) and gradient (N) at `positions`; turns the elements' rotations, `rotation_steps` times.
    double evaluate(const std::vector<Vec>& positions, std::vector<Vec>& gradient, int rotation_steps = 2);

    /// Elements that are inside out.
    int inverted(const std::vector<Vec>& positions) const;
    /// Deformation gradients at the surface nodes: means over the elements around, by volume.
    void surface_gradients(const std::vector<Vec>& positions, std::vector<Eigen::Matrix3f>& result) const;

    /// Weights for a scalar Laplacian that majorises the elements' Hessian: V theta (2 mu + 1.2 lambda).
    std::vector<float> laplacian_weights() const;
    /// What damping and contacts within `margin_m` of touching add on the diagonal.
    std::vector<float> diagonal_weights(const std::vector<Vec>& positions, double margin_m) const;

    /// Per element the quaternion x, y, z, w: all that the energy remembers besides its last frame.
    const AlignedArray<Real>& quaternions() const { return m_quaternion; }
    AlignedArray<Real>& quaternions() { return m_quaternion; }
    const std::vector<Vec>& last_frame() const { return m_last; }

  private:
    double elements(std::size_t begin, std::size_t end, const std::vector<Vec>& x, std::vector<Vec>& gradient,
                    int rotation_steps);
    double contacts(const std::vector<Vec>& x, std::vector<Vec>& gradient) const;

    std::vector<Tetrahedron> m_tetrahedra;
    // [(group * n + k) * kLanes + lane]: element group * kLanes + lane, padded with unit tetrahedra.
    AlignedArray<Real> m_inverse_rest;  // n = 9: inverse of the edge matrix, row by row
    AlignedArray<Real> m_material;      // n = 4: V theta, theta, 2 mu, lambda
    AlignedArray<Real> m_quaternion;    // n = 4
    std::vector<double> m_volume, m_theta;
    std::vector<Real> m_mass;          // fresh
    std::vector<Real> m_surface_area;  // of the surface nodes, which come first
    std::vector<ContactPlane> m_ground, m_neighbour;
    std::vector<Real> m_ground_friction, m_neighbour_friction;  // mu_f N_prev, N
    std::vector<Vec> m_last;
    std::vector<std::vector<Vec>> m_partial;
    std::vector<std::array<std::int32_t, 2>> m_surface_elements;  // (surface node, element) pairs
    Real m_mass_ratio = 1;
    Real m_gravity = 9.81F;
    FleshConstants m_constants;
};

extern template class FleshEnergy<float>;
extern template class FleshEnergy<double>;

}  // namespace windfall::decay
