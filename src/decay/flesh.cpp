#include "decay/flesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "decay/flesh_kernel.h"

namespace windfall::decay {

namespace {

using geometry::Vec3;

/// Pieces in which elements are summed: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t kFleshPieces = 8;

Eigen::Matrix3d edge_matrix(const FleshMesh& mesh, const Tetrahedron& t) {
    Eigen::Matrix3d D;
    for (int k = 0; k < 3; ++k) D.col(k) = mesh.nodes[t[k + 1]] - mesh.nodes[t[0]];
    return D;
}

template <class Vec>
Eigen::Vector3f position_of(const Vec& x) {
    return x.template head<3>().template cast<float>();
}

}  // namespace

template <class Real>
FleshEnergy<Real>::FleshEnergy(const FleshMesh& mesh, double density_kg_m3)
    : m_tetrahedra(mesh.tetrahedra),
      m_volume(mesh.tetrahedra.size()),
      m_theta(mesh.tetrahedra.size(), 1.0),
      m_mass(mesh.nodes.size(), Real(0)),
      m_surface_area(mesh.columns(), Real(0)),
      m_ground(mesh.columns()),
      m_ground_friction(mesh.columns(), Real(0)) {
    const std::size_t groups = (m_tetrahedra.size() + kLanes - 1) / kLanes;
    m_inverse_rest = AlignedArray<Real>(groups * 9 * kLanes);
    m_material = AlignedArray<Real>(groups * 4 * kLanes);
    m_quaternion = AlignedArray<Real>(groups * 4 * kLanes);
    for (std::size_t e = 0; e < groups * kLanes; ++e)
        m_quaternion[(e / kLanes * 4 + 3) * kLanes + e % kLanes] = 1;
    for (std::size_t e = 0; e < m_tetrahedra.size(); ++e) {
        const Tetrahedron& t = m_tetrahedra[e];
        const Eigen::Matrix3d D = edge_matrix(mesh, t);
        m_volume[e] = D.determinant() / 6;
        const Eigen::Matrix3d inverse = D.inverse();
        for (int k = 0; k < 9; ++k)
            m_inverse_rest[(e / kLanes * 9 + k) * kLanes + e % kLanes] =
                static_cast<Real>(inverse(k / 3, k % 3));
        for (const auto v : t) {
            m_mass[v] += static_cast<Real>(density_kg_m3 * m_volume[e] / 4);
            if (static_cast<std::size_t>(v) < surface_count())
                m_surface_elements.push_back({v, static_cast<std::int32_t>(e)});
        }
    }
    std::sort(m_surface_elements.begin(), m_surface_elements.end());
    const std::vector<Vec3> surface(mesh.nodes.begin(), mesh.nodes.begin() + mesh.columns());
    const std::vector<geometry::Face> faces(mesh.brick.quads.begin(), mesh.brick.quads.end());
    const auto areas = geometry::vertex_areas(surface, faces);
    std::transform(areas.begin(), areas.end(), m_surface_area.begin(),
                   [](double a) { return static_cast<Real>(a); });
    m_partial.assign(kFleshPieces, std::vector<Vec>(m_mass.size(), Vec::Zero()));
    m_last.resize(m_mass.size());
    std::transform(mesh.nodes.begin(), mesh.nodes.end(), m_last.begin(), [](const Vec3& x) {
        return Vec(static_cast<Real>(x.x()), static_cast<Real>(x.y()), static_cast<Real>(x.z()), 0);
    });
}

template <class Real>
void FleshEnergy<Real>::set_material(const std::vector<double>& modulus_pa,
                                     const std::vector<double>& theta) {
    const double nu = m_constants.poisson;
    for (std::size_t e = 0; e < m_tetrahedra.size(); ++e) {
        Real* at = &m_material[e / kLanes * 4 * kLanes + e % kLanes];
        at[0] = static_cast<Real>(m_volume[e] * theta[e]);
        at[kLanes] = static_cast<Real>(theta[e]);
        at[2 * kLanes] = static_cast<Real>(modulus_pa[e] / (1 + nu));
        at[3 * kLanes] = static_cast<Real>(modulus_pa[e] * nu / ((1 + nu) * (1 - 2 * nu)));
    }
    m_theta = theta;
}

template <class Real>
void FleshEnergy<Real>::set_planes(std::vector<ContactPlane> ground, std::vector<ContactPlane> neighbour) {
    m_ground = std::move(ground);
    m_neighbour = std::move(neighbour);
}

template <class Real>
void FleshEnergy<Real>::begin_frame(const std::vector<Vec>& positions) {
    m_last = positions;
    // The force of a frame ago bounds friction: so the energy of a frame stays smooth in the positions.
    const auto most_friction = [this](const std::vector<ContactPlane>& planes) {
        std::vector<Real> result(planes.size());
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const float gap = std::min(planes[i].gap_m(position_of(m_last[i])), 0.0F);
            result[i] =
                static_cast<Real>(-m_constants.friction * m_constants.contact_pa_m * gap) * m_surface_area[i];
        }
        return result;
    };
    m_ground_friction = most_friction(m_ground);
    m_neighbour_friction = most_friction(m_neighbour);
}

template <class Real>
double FleshEnergy<Real>::elements(std::size_t begin, std::size_t end, const std::vector<Vec>& x,
                                   std::vector<Vec>& gradient, int rotation_steps) {
    using V = typename FleshLanes<Real>::V;
    double energy = 0;
    for (std::size_t group = begin; group < end; ++group) {
        FleshGroup<V> work = {};
        const int count = static_cast<int>(std::min<std::size_t>(kLanes, element_count() - group * kLanes));
        const Tetrahedron* tetrahedra = &m_tetrahedra[group * kLanes];
        for (int lane = 0; lane < count; ++lane) {
            const Tetrahedron& t = tetrahedra[lane];
            for (int k = 0; k < 3; ++k) {
                const Vec edge = x[t[k + 1]] - x[t[0]];
                for (int r = 0; r < 3; ++r) work.edges[3 * r + k][lane] = edge[r];
            }
        }
        flesh_group(work, reinterpret_cast<const V*>(&m_inverse_rest[group * 9 * kLanes]),
                    reinterpret_cast<const V*>(&m_material[group * 4 * kLanes]),
                    reinterpret_cast<V*>(&m_quaternion[group * 4 * kLanes]), rotation_steps);
        for (int lane = 0; lane < count; ++lane) {
            const Tetrahedron& t = tetrahedra[lane];
            Vec sum = Vec::Zero();
            for (int k = 0; k < 3; ++k) {
                const Vec force(work.edges[k][lane], work.edges[3 + k][lane], work.edges[6 + k][lane], 0);
                gradient[t[k + 1]] += force;
                sum += force;
            }
            gradient[t[0]] -= sum;
            energy += work.energy[lane];
        }
    }
    return energy;
}

template <class Real>
double FleshEnergy<Real>::contacts(const std::vector<Vec>& x, std::vector<Vec>& gradient) const {
    double energy = 0;
    const auto add = [&](const ContactPlane& plane, Real friction, std::size_t i) {
        const Vec normal(plane.normal.x(), plane.normal.y(), plane.normal.z(), 0);
        const Real gap = normal.dot(x[i]) - plane.offset_m;
        if (gap < 0) {
            const Real stiffness = static_cast<Real>(m_constants.contact_pa_m) * m_surface_area[i];
            gradient[i] += stiffness * gap * normal;
            energy += 0.5 * stiffness * gap * gap;
        }
        if (friction > 0) {
            const Vec moved = x[i] - m_last[i];
            const Vec tangential = moved - normal.dot(moved) * normal;
            const Real slip = static_cast<Real>(m_constants.slip_m);
            const Real root = std::sqrt(tangential.squaredNorm() + slip * slip);
            gradient[i] += friction / root * tangential;
            energy += friction * (root - slip);
        }
    };
    for (std::size_t i = 0; i < m_ground.size(); ++i) add(m_ground[i], m_ground_friction[i], i);
    for (std::size_t i = 0; i < m_neighbour.size(); ++i) add(m_neighbour[i], m_neighbour_friction[i], i);
    return energy;
}

template <class Real>
double FleshEnergy<Real>::evaluate(const std::vector<Vec>& positions, std::vector<Vec>& gradient,
                                   int rotation_steps) {
    const std::size_t groups = (element_count() + kLanes - 1) / kLanes;
    const std::size_t piece = (groups + kFleshPieces - 1) / kFleshPieces;
    std::array<double, kFleshPieces> energies{};
    parallel_for_each(kFleshPieces, [&](std::size_t p) {
        std::fill(m_partial[p].begin(), m_partial[p].end(), Vec::Zero());
        energies[p] = elements(std::min(groups, p * piece), std::min(groups, (p + 1) * piece), positions,
                               m_partial[p], rotation_steps);
    });
    double energy = 0;
    for (const double e : energies) energy += e;
    const Real damping = static_cast<Real>(m_constants.damping_s2);
    gradient.resize(node_count());
    for (std::size_t i = 0; i < node_count(); ++i) {
        const Vec moved = positions[i] - m_last[i];
        const Real weight = m_mass[i] * m_mass_ratio * m_gravity;
        Vec sum = damping * m_mass[i] * moved;
        sum[2] += weight;
        for (const auto& partial : m_partial) sum += partial[i];
        gradient[i] = sum;
        energy += 0.5 * damping * m_mass[i] * moved.squaredNorm() + weight * positions[i][2];
    }
    return energy + contacts(positions, gradient);
}

template <class Real>
int FleshEnergy<Real>::inverted(const std::vector<Vec>& positions) const {
    const auto at = [&positions](std::int32_t v) -> Vec3 {
        return positions[v].template head<3>().template cast<double>();
    };
    return static_cast<int>(std::count_if(m_tetrahedra.begin(), m_tetrahedra.end(), [&](const auto& t) {
        return six_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3])) <= 0;
    }));
}

template <class Real>
void FleshEnergy<Real>::surface_gradients(const std::vector<Vec>& positions,
                                          std::vector<Eigen::Matrix3f>& result) const {
    std::vector<float> weight(surface_count(), 0.0F);
    result.assign(surface_count(), Eigen::Matrix3f::Zero());
    for (const auto& [v, e] : m_surface_elements) {
        const Tetrahedron& t = m_tetrahedra[e];
        Eigen::Matrix3f D, inverse;
        for (int k = 0; k < 3; ++k) D.col(k) = position_of(Vec(positions[t[k + 1]] - positions[t[0]]));
        for (int k = 0; k < 9; ++k)
            inverse(k / 3, k % 3) =
                static_cast<float>(m_inverse_rest[(e / kLanes * 9 + k) * kLanes + e % kLanes]);
        const auto volume = static_cast<float>(m_volume[e]);
        result[v] += volume * D * inverse;
        weight[v] += volume;
    }
    for (std::size_t v = 0; v < result.size(); ++v) result[v] /= weight[v];
}

template <class Real>
std::vector<float> FleshEnergy<Real>::laplacian_weights() const {
    std::vector<float> result(element_count());
    for (std::size_t e = 0; e < result.size(); ++e) {
        const Real* at = &m_material[e / kLanes * 4 * kLanes + e % kLanes];
        result[e] = static_cast<float>(at[0] * (at[2 * kLanes] + Real(1.2F) * at[3 * kLanes]));
    }
    return result;
}

template <class Real>
std::vector<float> FleshEnergy<Real>::diagonal_weights(const std::vector<Vec>& positions,
                                                       double margin_m) const {
    std::vector<float> result(node_count());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<float>(m_constants.damping_s2 * m_mass[i]);
    for (const auto* planes : {&m_ground, &m_neighbour})
        for (std::size_t i = 0; i < planes->size(); ++i)
            if ((*planes)[i].gap_m(position_of(positions[i])) < margin_m)
                result[i] += static_cast<float>(m_constants.contact_pa_m * m_surface_area[i]);
    for (const auto* friction : {&m_ground_friction, &m_neighbour_friction})
        for (std::size_t i = 0; i < friction->size(); ++i)
            result[i] += static_cast<float>((*friction)[i] / m_constants.slip_m);
    return result;
}

template class FleshEnergy<float>;
template class FleshEnergy<double>;

}  // namespace windfall::decay
