// Position-based dynamics of the particle lattice: beam theory, momentum, energy.
#include <gtest/gtest.h>

#include <cmath>

#include "fracture/particle_lattice.h"

namespace windfall::fracture {
namespace {

constexpr double kLength = 5;

/// A straight round rod of radius 1, density 1 and wave speed 1 along its fibres.
struct Rod {
    DiscPlan plan{3, 12};
    LatticeMaterial material;
    LatticeEnd end;
    Particles particles;
    std::vector<Spring> springs;

    explicit Rod(bool clamped, int discs = 20) {
        std::vector<double> levels;
        for (int k = 0; k <= discs; ++k) levels.push_back(kLength * k / discs);
        end.last_level = discs;
        const auto solid = [](int /*level*/, std::size_t /*column*/) { return CellShare{}; };
        add_lattice(
            end, plan, levels, material, solid, [](std::span<Eigen::Vector3f> /*points*/) {}, clamped,
            particles, springs);
    }
    double spacing() const { return kLength / end.last_level; }

    Point momentum() const {
        Point sum = Point::Zero();
        for (std::size_t i = 0; i < particles.size(); ++i)
            sum += particles.velocity[i] / particles.inverse_mass[i];
        return sum;
    }
    Point angular_momentum() const {
        Point sum = Point::Zero();
        for (std::size_t i = 0; i < particles.size(); ++i)
            sum += cross(particles.position[i], particles.velocity[i]) / particles.inverse_mass[i];
        return sum;
    }
    double kinetic_energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < particles.size(); ++i)
            sum += particles.velocity[i].squaredNorm() / particles.inverse_mass[i] / 2;
        return sum;
    }
    /// Stirs the rod: every particle by its number, all together about `drift`.
    void stir(double strength, const Point& drift) {
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const auto n = static_cast<double>(i);
            particles.velocity[i] =
                drift + strength * point(std::sin(1.3 * n), std::cos(0.7 * n), std::sin(2.1 * n + 1));
        }
    }
};

/// Deflection of a horizontal cantilever's end under its own weight, at rest, in steps of `step` discs' wave
/// time.
double sag(double relative_step) {
    constexpr double kWeight = 1e-5;
    Rod rod(true);
    const double step = relative_step * rod.spacing();
    const auto constraints = prepare(rod.springs, rod.particles, step);
    const double damping = 1 - 0.14 * step;  // about critical for the first mode
    for (double time = 0; time < 140; time += step) {
        predict(rod.particles, point(kWeight, 0, 0), step);
        project(constraints, rod.particles);
        update_velocities(rod.particles, step);
        for (Point& v : rod.particles.velocity) v *= damping;
    }
    double tip = 0;
    for (std::size_t c = 0; c < rod.plan.size(); ++c)
        tip += rod.plan.area(c) *
               (rod.particles.position[rod.end.at(rod.end.last_level, c)].x() - rod.plan.x(c));
    return tip / M_PI / kWeight;
}

/// By Timoshenko's beam: w L^4 / (8 E I) + w L^2 / (2 k G A), with the second moment of the lattice's disc.
double beam_sag() {
    const Rod rod(true);
    double second_moment = 0;
    for (std::size_t c = 0; c < rod.plan.size(); ++c)
        second_moment += rod.plan.area(c) * rod.plan.x(c) * rod.plan.x(c);
    EXPECT_NEAR(second_moment, M_PI / 4, 0.06 * M_PI / 4);
    const double bending = M_PI * std::pow(kLength, 4) / (8 * rod.material.along * second_moment);
    const double shear = kLength * kLength / (2 * 0.9 * rod.material.shear);
    return bending + shear;
}

TEST(BreakingLattice, CantileverSagsAsBeamTheorySays) {
    const double coarse = sag(1), middle = sag(0.5), fine = sag(0.25);
    EXPECT_NEAR(fine / beam_sag(), 1, 0.05);
    // One sweep a step leaves the lattice softer by a part that goes with the square of the step.
    EXPECT_GT(middle, fine);
    EXPECT_NEAR((coarse - middle) / (middle - fine), 4, 1);
}

TEST(BreakingLattice, EveryInnerParticleHasSixNeighboursOnItsFibreRingAndRay) {
    const Rod rod(false);
    const std::size_t here = rod.end.at(10, rod.plan.column(2, 5));
    const std::size_t wanted[6] = {
        rod.end.at(9, rod.plan.column(2, 5)),  rod.end.at(11, rod.plan.column(2, 5)),
        rod.end.at(10, rod.plan.column(2, 4)), rod.end.at(10, rod.plan.column(2, 6)),
        rod.end.at(10, rod.plan.column(1, 5)), rod.end.at(10, rod.plan.column(3, 5))};
    for (std::size_t neighbour : wanted) {
        int links = 0;
        for (const Spring& s : rod.springs) {
            const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
            links += static_cast<int>((a == here && b == neighbour) || (a == neighbour && b == here));
        }
        EXPECT_EQ(links, 1);
    }
    double mass = 0;
    for (double inverse : rod.particles.inverse_mass) mass += 1 / inverse;
    EXPECT_NEAR(mass, M_PI * kLength, 1e-9);
}

TEST(BreakingLattice, FreeRodKeepsItsMomentum) {
    Rod rod(false);
    const double step = rod.spacing();
    const auto constraints = prepare(rod.springs, rod.particles, step);
    rod.stir(0.003, point(0.01, -0.02, 0.005));
    const Point before = rod.momentum(), spin = rod.angular_momentum();
    const double energy = rod.kinetic_energy();
    for (int i = 0; i < 400; ++i) {
        predict(rod.particles, Point::Zero(), step);
        project(constraints, rod.particles);
        update_velocities(rod.particles, step);
        if (i % 4 == 0) damp_relative(rod.particles, 0, rod.particles.size(), 0.05);
    }
    EXPECT_LT((rod.momentum() - before).norm(), 1e-12 * before.norm() * 400);
    EXPECT_LT((rod.angular_momentum() - spin).norm(), 1e-5 * spin.norm());
    EXPECT_LT(rod.kinetic_energy(), energy);
    // What is left is the motion as a whole: the relative part of the energy is gone, the drift is not.
    const double drift = before.squaredNorm() / (2 * M_PI * kLength);
    EXPECT_GT(rod.kinetic_energy(), drift);
    EXPECT_LT(rod.kinetic_energy() - drift, 0.5 * (energy - drift));
}

TEST(BreakingLattice, FreeRodFallsByHalfGTSquared) {
    Rod rod(false);
    const double step = 0.2, gravity = 1e-3;
    const auto constraints = prepare(rod.springs, rod.particles, step);
    rod.stir(0.003, Point::Zero());
    const RigidMotion start = RigidMotion::of(rod.particles, 0, rod.particles.size());
    const int steps = 500;
    for (int i = 0; i < steps; ++i) {
        predict(rod.particles, point(0, 0, -gravity), step);
        project(constraints, rod.particles);
        update_velocities(rod.particles, step);
    }
    const RigidMotion end = RigidMotion::of(rod.particles, 0, rod.particles.size());
    const double time = steps * step;
    const double fall = start.centre.z() + start.velocity.z() * time - end.centre.z();
    EXPECT_NEAR(fall, gravity * time * (time + step) / 2, 1e-9);  // symplectic Euler's g t (t + dt) / 2
    EXPECT_NEAR(fall, gravity * time * time / 2, 0.003 * fall);
}

TEST(BreakingLattice, RigidTurnIsNoStrain) {
    Rod rod(false, 8);
    const auto constraints = prepare(rod.springs, rod.particles, 0.1);
    const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, 2, 3).normalized());
    for (Point& x : rod.particles.position) x.head<3>() = turn * x.head<3>();
    const std::vector<Point> before = rod.particles.position;
    project(constraints, rod.particles);
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_LT((rod.particles.position[i] - before[i]).norm(), 1e-12);
}

TEST(BreakingLattice, InterpolatesOverTheDisc) {
    const DiscPlan plan(4, 16);
    std::vector<double> values;
    for (std::size_t c = 0; c < plan.size(); ++c) values.push_back(2 * plan.x(c) - plan.y(c) + 3);
    for (std::size_t c = 0; c < plan.size(); ++c) {
        EXPECT_NEAR(plan.interpolate(values, plan.x(c), plan.y(c)), values[c], 1e-9);
        EXPECT_EQ(plan.nearest(plan.x(c), plan.y(c)), c);
    }
    EXPECT_NEAR(plan.interpolate(values, 0.3, 0.4), 3.2, 0.05);
    EXPECT_NEAR(plan.interpolate(values, -3, 0), 1, 0.01);  // as at the rim
}

}  // namespace
}  // namespace windfall::fracture
