#include "fracture/breaking_contact.h"

#include <algorithm>
#include <cmath>

namespace windfall::fracture {

namespace {

constexpr double kFriction = 0.5;
/// Distance at which a particle counts as clear of the other end, radii.
constexpr double kClear = 0.15;

/// Takes from the way of this step along the contact what friction under `depth` of pressure can take.
Point rubbed(const Point& way, const Point& normal, double depth) {
    const Point along = way - way.dot(normal) * normal;
    const double length = along.norm();
    if (length < 1e-15) return Point::Zero();
    return -std::min(1.0, kFriction * depth / length) * along;
}

/// The disc at or below (above) a height, among those of an end.
int level_within(const BreakingLattice& lattice, const LatticeEnd& end, double height, bool above) {
    const auto found = std::upper_bound(lattice.levels.begin(), lattice.levels.end(), height);
    const int below = static_cast<int>(found - lattice.levels.begin()) - 1;
    return std::clamp(above ? below + 1 : below, end.first_level, end.last_level);
}

/// Particles of the end's wood on its bark and, of each column, the one next to the broken surface.
std::vector<std::size_t> surface_particles(const BreakingLattice& lattice, const LatticeEnd& end) {
    const bool is_stub = end.first_level == 0;
    std::vector<std::size_t> result;
    for (int k = end.first_level; k <= end.last_level; ++k)
        for (std::size_t c = 0; c < lattice.plan.size(); ++c) {
            const auto holds = [&](int level) {
                return level >= end.first_level && level <= end.last_level &&
                       lattice.stub_holds(level, c) == is_stub;
            };
            const bool bark = lattice.plan.ring(c) == lattice.plan.rings();
            if (holds(k) && (bark || !holds(is_stub ? k + 1 : k - 1))) result.push_back(end.at(k, c));
        }
    return result;
}

}  // namespace

GroundContact::GroundContact(const BreakingLattice& lattice) : m_ground(lattice.ground) {
    for (int k = lattice.piece.first_level; k <= lattice.piece.last_level; ++k)
        for (std::size_t c = 0; c < lattice.plan.size(); ++c)
            if (lattice.piece_holds(k, c)) m_wood.push_back(lattice.piece.at(k, c));
}

void GroundContact::project(Particles& particles) {
    m_touching = 0;
    for (std::size_t i : m_wood) {
        Point& x = particles.position[i];
        const double depth = m_ground - x.z();
        if (depth <= 0) continue;
        ++m_touching;
        x += rubbed(x - particles.previous[i], point(0, 0, 1), depth);
        x.z() = m_ground;
    }
}

EndContact::EndContact(const BreakingLattice& lattice)
    : m_stub_points(surface_particles(lattice, lattice.stub)),
      m_piece_points(surface_particles(lattice, lattice.piece)),
      m_slow_way(0.3 * std::sqrt(lattice.gravity) * lattice.step) {
    clear.assign(m_stub_points.size() + m_piece_points.size(), 0);
}

void EndContact::push(std::size_t own, std::size_t other, const Inside& inside, Particles& particles) const {
    const double own_weight = particles.inverse_mass[own], other_weight = particles.inverse_mass[other];
    if (own_weight + other_weight == 0) return;
    const Point way = (particles.position[own] - particles.previous[own]) -
                      (particles.position[other] - particles.previous[other]);
    // Stops what comes nearer; what is inside already leaves slowly, or it would be shot out.
    const double depth = std::min(inside.depth, std::max(-way.dot(inside.way_out), 0.0) + m_slow_way);
    const Point move = depth * inside.way_out + rubbed(way, inside.way_out, depth);
    particles.position[own] += own_weight / (own_weight + other_weight) * move;
    particles.position[other] -= other_weight / (own_weight + other_weight) * move;
}

void EndContact::project(const BreakingLattice& lattice, const EndFrame& stub, const EndFrame& piece,
                         Particles& particles) {
    std::size_t next = 0;
    const auto test = [&](std::size_t own, bool own_is_stub) {
        const Point& where = particles.position[own];
        const Inside inside =
            own_is_stub ? inside_piece(lattice, piece, where) : inside_stub(lattice, stub, where);
        std::uint8_t& is_clear = clear[next++];
        if (inside.depth < -kClear) is_clear = 1;
        if (inside.depth <= 0 || is_clear == 0) return;
        const EndFrame& frame = own_is_stub ? piece : stub;
        const LatticeEnd& end = own_is_stub ? lattice.piece : lattice.stub;
        const Point local = frame.unplaced(where);
        const int level = level_within(lattice, end, local.z(), own_is_stub);
        push(own, end.at(level, lattice.plan.nearest(local.x(), local.y())), inside, particles);
    };
    for (std::size_t i : m_stub_points) test(i, true);
    for (std::size_t i : m_piece_points) test(i, false);
}

}  // namespace windfall::fracture
