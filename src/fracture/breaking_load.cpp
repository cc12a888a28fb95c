#include "fracture/breaking_load.h"

#include <algorithm>
#include <cmath>

namespace windfall::fracture {

namespace {

constexpr double kFarthest = 2.0;  // rad; beyond it every hinge has let go
constexpr double kPace = 2.5;      // the push grows with this power of time, so that the bending can be seen
/// Share of the way to the target that the push goes in one step: soft, as a hand or the wind is.
constexpr double kFirmness = 0.02;

}  // namespace

BreakingLoad::BreakingLoad(const FractureParameters& parameters, const BreakingLattice& lattice,
                           double seconds)
    : m_seconds(seconds), m_twist(parameters.load.twist) {
    const LatticeEnd& piece = lattice.piece;
    const int pushed = std::max(1, (piece.last_level - piece.first_level) / 5);
    m_begin = piece.at(piece.last_level - pushed + 1, 0);
    m_end = piece.past();
    m_root = piece.at(piece.first_level, 0);

    const TensionField field = tension_field(parameters);
    m_fall = point(-field.cos_a, -field.sin_a, 0);
    double height = 0, weights = 0;
    for (std::size_t c = 0; c < lattice.plan.size(); ++c) {
        const double along = lattice.plan.x(c) * m_fall.x() + lattice.plan.y(c) * m_fall.y();
        if (along < 0.6) continue;
        height += lattice.plan.area(c) * lattice.heights[c];
        weights += lattice.plan.area(c);
    }
    m_hinge = m_fall + point(0, 0, height / weights);
    for (std::size_t i = m_begin; i < m_end; ++i) m_mass += 1 / lattice.particles.inverse_mass[i];
    const Point middle = centre(lattice.particles);
    for (std::size_t i = m_begin; i < m_end; ++i) {
        const Point arm = lattice.particles.position[i] - middle;
        m_inertia += arm.head<2>().squaredNorm() / lattice.particles.inverse_mass[i];
    }
    m_rest_angle = angle(lattice.particles);
}

double BreakingLoad::target(double time) const {
    return kFarthest * std::pow(std::clamp(time / m_seconds, 0.0, 1.0), kPace);
}

Point BreakingLoad::centre(const Particles& particles) const {
    Point sum = Point::Zero();
    for (std::size_t i = m_begin; i < m_end; ++i) sum += particles.position[i] / particles.inverse_mass[i];
    return sum / m_mass;
}

double BreakingLoad::angle(const Particles& particles) const {
    const Point arm = centre(particles) - m_hinge;
    return std::atan2(arm.dot(m_fall), arm.z()) - m_rest_angle;
}

void BreakingLoad::project(Particles& particles, double time, double step) {
    const Point arm = centre(particles) - m_hinge;
    const double out = arm.dot(m_fall), up = arm.z();
    const double missing = target(time) - (std::atan2(out, up) - m_rest_angle);
    const double reach = std::hypot(out, up);
    const double way = time <= m_seconds ? kFirmness * std::clamp(missing, 0.0, 0.5) * reach : 0.0;
    if (way > 0) {
        const Point direction = (up * m_fall - point(0, 0, out)) / reach;
        for (std::size_t i = m_begin; i < m_end; ++i) particles.position[i] += way * direction;
    }
    // Smoothed over some fifty steps: the push shakes with the waves in the wood.
    moment += 0.02 * (m_mass * way / (step * step) * reach - moment);
}

void BreakingLoad::twist(Particles& particles, double step) const {
    if (m_twist == 0) return;
    const Point middle = centre(particles);
    const Point axis = (middle - particles.position[m_root]).normalized();
    const Point spin = step * m_twist * moment / m_inertia * axis;
    for (std::size_t i = m_begin; i < m_end; ++i)
        particles.velocity[i] += cross(spin, particles.position[i] - middle);
}

}  // namespace windfall::fracture
