#include "decay/spring_network.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "decay/flesh_solver.h"
#include "support/body_fruit.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;

constexpr double kModulus_pa = 5e4;
constexpr double kLoss = 0.10;

FleshMesh soft_fruit() {
    const SurfaceFunction surface = test::ribbed_fruit(0.03, 0.02, 0.1, 0.9);
    FleshMesh mesh = make_flesh_mesh(surface, towards_centre(surface, Vec3::Zero()), 4, 4);
    double lowest = 0;
    for (const Vec3& x : mesh.nodes) lowest = std::min(lowest, x.z());
    for (Vec3& x : mesh.nodes) x.z() -= lowest;
    return mesh;
}

struct Outline {
    double volume_m3, height_m;
};

template <class At>
Outline outline_of(const FleshMesh& mesh, const At& at) {
    std::vector<Vec3> surface;
    double low = 1, high = 0;
    for (std::size_t i = 0; i < mesh.columns(); ++i) {
        surface.push_back(at(i));
        low = std::min(low, surface.back().z());
        high = std::max(high, surface.back().z());
    }
    return {geometry::enclosed_volume(surface, {mesh.brick.quads.begin(), mesh.brick.quads.end()}),
            high - low};
}

/// Steps until `seconds` have passed, at a share of the critical step.
void run(SpringNetwork& springs, double seconds, double share) {
    const double dt = share * springs.critical_step_s();
    for (double t = 0; t < seconds; t += dt) springs.step(dt);
}

TEST(SpringNetwork, KeepsStillInFreeSpaceAndShrinksToItsRestLengths) {
    const FleshMesh mesh = soft_fruit();
    SpringNetwork springs(mesh, {.modulus_pa = kModulus_pa, .gravity_m_s2 = 0});
    const double dt = 0.8 * springs.critical_step_s();
    springs.step(dt);
    EXPECT_LT(springs.kinetic_j(), 1e-20);
    springs.set_loss(kLoss, 0);
    run(springs, 0.5, 0.8);
    const double fresh = outline_of(mesh, [&](std::size_t i) { return mesh.nodes[i]; }).volume_m3;
    const double now = outline_of(mesh, [&](std::size_t i) { return springs.positions()[i]; }).volume_m3;
    EXPECT_NEAR(now / fresh, 1 - kLoss, 1e-3);
}

TEST(SpringNetwork, CriticalStepSeparatesStableFromUnstable) {
    const FleshMesh mesh = soft_fruit();
    const auto liveliest = [&](double share, double table_pa_m) {
        SpringNetwork springs(
            mesh, {.modulus_pa = kModulus_pa, .damping_1_s = 0, .table_pa_m = table_pa_m, .gravity_m_s2 = 0});
        const double dt = share * springs.critical_step_s();
        springs.set_loss(0.01, 0);
        double most = 0;
        for (int step = 0; step < 400 && most < 1; ++step) {
            springs.step(dt);
            most = std::max(most, springs.kinetic_j());
        }
        return most;
    };
    // Without a table the network's own highest frequency decides.
    EXPECT_LT(liveliest(0.95, 0), 1e-2);
    EXPECT_GT(liveliest(1.3, 0), 1);
    EXPECT_LT(liveliest(0.95, 3e7), 1e-2);
}

TEST(SpringNetwork, DefaultFleshAgreesOnASmallSoftFruit) {
    const FleshMesh mesh = soft_fruit();
    SpringNetwork springs(mesh, {.modulus_pa = kModulus_pa});
    run(springs, 0.3, 0.8);
    springs.set_loss(kLoss, 0);
    run(springs, 0.7, 0.8);
    EXPECT_LT(springs.kinetic_j(), 1e-7);
    const Outline reference = outline_of(mesh, [&](std::size_t i) { return springs.positions()[i]; });

    FleshSolver solver(mesh, 1000);
    auto& energy = solver.energy();
    energy.set_material(std::vector<double>(energy.element_count(), kModulus_pa),
                        std::vector<double>(energy.element_count(), std::cbrt(1 - kLoss)));
    energy.set_planes(std::vector<ContactPlane>(energy.surface_count(), {{0, 0, 1}, 0}), {});
    for (int frame = 0; frame < 200; ++frame) {
        solver.begin_frame();
        solver.descend(2, 2, 0);
    }
    const Outline flesh = outline_of(
        mesh, [&](std::size_t i) -> Vec3 { return solver.positions()[i].head<3>().cast<double>(); });
    // Springs have Poisson's ratio 1/4, the default 0.45: under its weight the fruit of springs loses more
    // volume.
    EXPECT_NEAR(flesh.volume_m3 / reference.volume_m3, 1, 0.03);
    EXPECT_NEAR(flesh.height_m / reference.height_m, 1, 0.03);
}

}  // namespace
}  // namespace windfall::decay
