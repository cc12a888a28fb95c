#include "decay/spring_network.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace windfall::decay {

namespace {

using geometry::Vec3;

/// Isotropic springs of stiffness k and length l in a volume V make a solid with C11 = 3 C12 = 3 C44 = sum k
/// l^2 / 5 V, hence E = sum k l^2 / 6 V: each of a tetrahedron's six springs gets E V / l^2.
std::map<std::array<std::int32_t, 2>, double> stiffness_sums(const FleshMesh& mesh, double modulus_pa) {
    std::map<std::array<std::int32_t, 2>, double> sums;
    for (const Tetrahedron& t : mesh.tetrahedra) {
        const double volume =
            six_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]) / 6;
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j)
                sums[{std::min(t[i], t[j]), std::max(t[i], t[j])}] +=
                    modulus_pa * volume / (mesh.nodes[t[i]] - mesh.nodes[t[j]]).squaredNorm();
    }
    return sums;
}

}  // namespace

SpringNetwork::SpringNetwork(const FleshMesh& mesh, const SpringSettings& settings)
    : m_settings(settings),
      m_mass_kg(mesh.nodes.size(), 0.0),
      m_positions(mesh.nodes),
      m_velocities(mesh.nodes.size(), Vec3::Zero()) {
    for (const auto& [edge, stiffness] : stiffness_sums(mesh, settings.modulus_pa)) {
        m_edges.push_back(edge);
        m_fresh_stiffness.push_back(stiffness);
        m_fresh_length_m.push_back((mesh.nodes[edge[0]] - mesh.nodes[edge[1]]).norm());
    }
    for (const Tetrahedron& t : mesh.tetrahedra)
        for (const auto v : t)
            m_mass_kg[v] +=
                settings.density_kg_m3 *
                six_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]) / 24;
    m_surface_area_m2 = geometry::vertex_areas({mesh.nodes.begin(), mesh.nodes.begin() + mesh.columns()},
                                               {mesh.brick.quads.begin(), mesh.brick.quads.end()});
    set_loss(0, 0);
}

void SpringNetwork::set_loss(double water_fraction_lost, double softening) {
    const double ratio = std::cbrt(1 - water_fraction_lost);
    m_length_m = m_fresh_length_m;
    m_stiffness = m_fresh_stiffness;
    for (double& l : m_length_m) l *= ratio;
    for (double& k : m_stiffness) k *= 1 - softening;
}

void SpringNetwork::accelerations(const Points& x, const Points& v, Points& a) const {
    a.assign(x.size(), Vec3::Zero());
    for (std::size_t e = 0; e < m_edges.size(); ++e) {
        const auto [i, j] = m_edges[e];
        const Vec3 edge = x[j] - x[i];
        const double length = edge.norm();
        const Vec3 force = m_stiffness[e] * (1 - m_length_m[e] / length) * edge;
        a[i] += force;
        a[j] -= force;
    }
    for (std::size_t i = 0; i < m_surface_area_m2.size(); ++i)
        if (x[i].z() < 0) a[i].z() -= m_settings.table_pa_m * m_surface_area_m2[i] * x[i].z();
    for (std::size_t i = 0; i < x.size(); ++i) {
        a[i] = a[i] / m_mass_kg[i] - m_settings.damping_1_s * v[i];
        a[i].z() -= m_settings.gravity_m_s2;
    }
}

double SpringNetwork::critical_step_s() const {
    constexpr int kIterations = 60;
    const std::size_t n = m_positions.size();
    Points u(n), image(n);
    for (std::size_t i = 0; i < n; ++i)
        u[i] = Vec3(std::sin(1.0 + static_cast<double>(i)), std::sin(2.0 * static_cast<double>(i)),
                    std::cos(3.0 * static_cast<double>(i)));
    double frequency_sq = 0;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        image.assign(n, Vec3::Zero());
        for (std::size_t e = 0; e < m_edges.size(); ++e) {
            const auto [i, j] = m_edges[e];
            const Vec3 along = (m_positions[j] - m_positions[i]).normalized();
            const Vec3 force = m_stiffness[e] * along * along.dot(u[j] - u[i]);
            image[i] -= force;
            image[j] += force;
        }
        // As if all of the surface lay on the table: it may, later.
        for (std::size_t i = 0; i < m_surface_area_m2.size(); ++i)
            image[i].z() += m_settings.table_pa_m * m_surface_area_m2[i] * u[i].z();
        double square = 0;
        double product = 0;
        for (std::size_t i = 0; i < n; ++i) {
            image[i] /= m_mass_kg[i];
            product += image[i].dot(u[i]);
            square += u[i].squaredNorm();
        }
        frequency_sq = product / square;
        double norm = 0;
        for (const Vec3& x : image) norm += x.squaredNorm();
        for (std::size_t i = 0; i < n; ++i) u[i] = image[i] / std::sqrt(norm);
    }
    return 2 * std::sqrt(2.0 / frequency_sq);
}

void SpringNetwork::step(double dt_s) {
    const std::size_t n = m_positions.size();
    const Points x0 = m_positions;
    const Points v0 = m_velocities;
    Points x = x0, v = v0, a;
    Points dx(n, Vec3::Zero()), dv(n, Vec3::Zero());
    constexpr std::array<double, 4> kAhead = {0, 0.5, 0.5, 1};
    constexpr std::array<double, 4> kWeight = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    for (int stage = 0; stage < 4; ++stage) {
        if (stage > 0)
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3 previous_velocity = v[i];
                x[i] = x0[i] + kAhead[stage] * dt_s * previous_velocity;
                v[i] = v0[i] + kAhead[stage] * dt_s * a[i];
            }
        accelerations(x, v, a);
        for (std::size_t i = 0; i < n; ++i) {
            dx[i] += kWeight[stage] * dt_s * v[i];
            dv[i] += kWeight[stage] * dt_s * a[i];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        m_positions[i] = x0[i] + dx[i];
        m_velocities[i] = v0[i] + dv[i];
    }
}

double SpringNetwork::kinetic_j() const {
    double energy = 0;
    for (std::size_t i = 0; i < m_mass_kg.size(); ++i)
        energy += 0.5 * m_mass_kg[i] * m_velocities[i].squaredNorm();
    return energy;
}

}  // namespace windfall::decay
