#include "fracture/particle_system.h"

#include <Eigen/LU>
#include <algorithm>

namespace windfall::fracture {

void Particles::add(const Point& where, double mass) {
    position.push_back(where);
    previous.push_back(where);
    velocity.emplace_back(Point::Zero());
    inverse_mass.push_back(mass > 0 ? 1 / mass : 0);
}

std::vector<DistanceConstraint> prepare(const std::vector<Spring>& springs, const Particles& particles,
                                        double step) {
    std::vector<DistanceConstraint> result;
    result.reserve(springs.size());
    for (const Spring& spring : springs) {
        const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
        const double wa = particles.inverse_mass[a], wb = particles.inverse_mass[b];
        if (wa + wb == 0) continue;
        const double whole = wa + wb + 1 / (spring.stiffness * step * step);
        const double rest_sq = (particles.position[a] - particles.position[b]).squaredNorm();
        result.push_back({spring.a, spring.b, 1 / rest_sq, wa / whole, wb / whole});
    }
    return result;
}

void predict(Particles& particles, const Point& gravity, double step) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles.previous[i] = particles.position[i];
        if (particles.inverse_mass[i] == 0) continue;
        particles.velocity[i] += step * gravity;
        particles.position[i] += step * particles.velocity[i];
    }
}

void project(const std::vector<DistanceConstraint>& constraints, Particles& particles) {
    Point* const x = particles.position.data();
    for (const DistanceConstraint& c : constraints) {
        const Point d = x[c.a] - x[c.b];
        // Far beyond any wood's strain the linear law would overshoot.
        const double strain = std::min(0.5 * (d.squaredNorm() * c.inverse_rest_sq - 1), 0.5);
        x[c.a] -= (c.share_a * strain) * d;
        x[c.b] += (c.share_b * strain) * d;
    }
}

void update_velocities(Particles& particles, double step) {
    const double rate = 1 / step;
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.velocity[i] = rate * (particles.position[i] - particles.previous[i]);
}

RigidMotion RigidMotion::of(const Particles& particles, std::size_t begin, std::size_t end) {
    RigidMotion motion;
    for (std::size_t i = begin; i < end; ++i) {
        const double mass = 1 / particles.inverse_mass[i];
        motion.mass += mass;
        motion.centre += mass * particles.position[i];
        motion.velocity += mass * particles.velocity[i];
    }
    motion.centre /= motion.mass;
    motion.velocity /= motion.mass;
    Point angular = Point::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (std::size_t i = begin; i < end; ++i) {
        const double mass = 1 / particles.inverse_mass[i];
        const Point arm = particles.position[i] - motion.centre;
        angular += mass * cross(arm, particles.velocity[i]);
        const Eigen::Vector3d r = arm.head<3>();
        inertia += mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    }
    motion.spin.head<3>() = inertia.inverse() * angular.head<3>();
    return motion;
}

void damp_relative(Particles& particles, std::size_t begin, std::size_t end, double share) {
    const RigidMotion motion = RigidMotion::of(particles, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
        const Point wanted = motion.at(particles.position[i]);
        particles.velocity[i] += share * (wanted - particles.velocity[i]);
    }
}

}  // namespace windfall::fracture
