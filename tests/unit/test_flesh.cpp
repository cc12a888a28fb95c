#include "decay/flesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "decay/flesh_preconditioner.h"
#include "decay/flesh_solver.h"
#include "support/body_fruit.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;
using Twin = FleshEnergy<double>;

FleshMesh small_mesh() {
    const SurfaceFunction surface = test::body_tomato();
    return make_flesh_mesh(surface, towards_centre(surface, Vec3::Zero()), 3, 3);
}

/// Uneven material: no two elements alike.
void set_uneven_material(Twin& energy) {
    std::vector<double> modulus, theta;
    for (std::size_t e = 0; e < energy.element_count(); ++e) {
        modulus.push_back(2e4 * (1 + 0.5 * std::sin(0.7 * static_cast<double>(e))));
        theta.push_back(0.85 + 0.1 * std::cos(1.3 * static_cast<double>(e)));
    }
    energy.set_material(modulus, theta);
}

/// The mesh, bent and dented.
std::vector<Twin::Vec> disturbed(const FleshMesh& mesh, double by_m) {
    std::vector<Twin::Vec> x;
    for (const Vec3& p : mesh.nodes) {
        const Vec3 q = 300 * p;
        x.emplace_back(p.x() + by_m * std::sin(q.y() + 1), p.y() + by_m * std::cos(q.z() - q.x()),
                       p.z() + by_m * std::sin(q.x() * 0.7 + q.y()), 0);
    }
    return x;
}

TEST(FleshMesh, FillsTheFruitWithWellTurnedTetrahedra) {
    const SurfaceFunction surface = test::body_tomato();
    const FleshMesh mesh = make_flesh_mesh(surface, towards_centre(surface, Vec3::Zero()), 6, 5);
    EXPECT_EQ(mesh.nodes.size(), 5U * 218U + 1U);
    EXPECT_EQ(mesh.tetrahedra.size(), 432U * (3U * 4U + 1U));
    double volume = 0;
    for (const Tetrahedron& t : mesh.tetrahedra)
        volume += six_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]) / 6;
    const std::vector<Vec3> skin(mesh.nodes.begin(), mesh.nodes.begin() + 218);
    EXPECT_NEAR(volume, geometry::enclosed_volume(skin, {mesh.brick.quads.begin(), mesh.brick.quads.end()}),
                0.01 * volume);
    // Euler's formula for a solid ball of tetrahedra holds only when neighbours share whole faces.
    std::set<std::array<std::int32_t, 3>> faces;
    for (const Tetrahedron& t : mesh.tetrahedra)
        for (int k = 0; k < 4; ++k) {
            std::array<std::int32_t, 3> face{t[k], t[(k + 1) % 4], t[(k + 2) % 4]};
            std::sort(face.begin(), face.end());
            faces.insert(face);
        }
    EXPECT_EQ(static_cast<int>(mesh.nodes.size()) - static_cast<int>(edges_of(mesh.tetrahedra).size()) +
                  static_cast<int>(faces.size()) - static_cast<int>(mesh.tetrahedra.size()),
              1);
}

TEST(FleshMesh, RefusesAFruitThatDoesNotSeeItsCentre) {
    const SurfaceFunction surface = test::body_tomato();
    const auto far_off = towards_centre(surface, Vec3(0.2, 0, 0));
    EXPECT_THAT(message_of([&] { make_flesh_mesh(surface, far_off, 4, 3); }), HasSubstr("folds over"));
    EXPECT_THROW(make_flesh_mesh(surface, far_off, 1, 3), InputError);
}

TEST(FleshEnergy, GradientIsTheDerivativeOfTheEnergy) {
    const FleshMesh mesh = small_mesh();
    Twin energy(mesh, 1000);
    set_uneven_material(energy);
    const auto x = disturbed(mesh, 1.5e-3);
    // Contacts on both kinds of planes, some of which held a frame ago.
    std::vector<ContactPlane> ground, neighbour;
    for (std::size_t i = 0; i < energy.surface_count(); ++i) {
        ground.push_back({{0, 0, 1}, -0.02F});
        neighbour.push_back({Eigen::Vector3f(-1, 0.2F, 0.1F).normalized(), -0.03F});
    }
    energy.set_planes(ground, neighbour);
    energy.begin_frame(disturbed(mesh, 1.2e-3));
    constexpr int kConverged = 60;
    std::vector<Twin::Vec> gradient, unused;
    energy.evaluate(x, gradient, kConverged);
    double largest = 0;
    for (const auto& g : gradient) largest = std::max(largest, g.cwiseAbs().maxCoeff());
    ASSERT_GT(largest, 1e-3);
    constexpr double kStep_m = 1e-7;
    int touched = 0;
    for (std::size_t i = 0; i < x.size(); i += 2)
        for (int axis = 0; axis < 3; ++axis) {
            auto moved = x;
            moved[i][axis] += kStep_m;
            const double above = energy.evaluate(moved, unused, kConverged);
            moved[i][axis] -= 2 * kStep_m;
            const double below = energy.evaluate(moved, unused, kConverged);
            EXPECT_NEAR(gradient[i][axis], (above - below) / (2 * kStep_m), 1e-6 * largest)
                << i << " " << axis;
            if (i < ground.size() && ground[i].gap_m(x[i].head<3>().cast<float>()) < 0) ++touched;
        }
    EXPECT_GT(touched, 0);
}

TEST(FleshEnergy, FreshFleshAtRestFeelsNoForceButItsWeight) {
    const FleshMesh mesh = small_mesh();
    Twin energy(mesh, 1000);
    energy.set_material(std::vector<double>(energy.element_count(), 1e5),
                        std::vector<double>(energy.element_count(), 1.0));
    energy.set_gravity(0);
    std::vector<Twin::Vec> gradient;
    const auto rest = disturbed(mesh, 0);
    EXPECT_NEAR(energy.evaluate(rest, gradient), 0, 1e-15);
    for (const auto& g : gradient) EXPECT_LT(g.norm(), 1e-10);
    energy.set_gravity(10);
    energy.evaluate(rest, gradient);
    Twin::Vec sum = Twin::Vec::Zero();
    for (const auto& g : gradient) sum += g;
    double volume = 0;
    for (const Tetrahedron& t : mesh.tetrahedra)
        volume += six_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]) / 6;
    EXPECT_NEAR(sum[2], 1e4 * volume, 1e-9);
}

TEST(FleshEnergy, TurningAndShrinkingByThetaCostNothing) {
    const FleshMesh mesh = small_mesh();
    Twin energy(mesh, 1000);
    constexpr double kTheta = 0.8;
    energy.set_material(std::vector<double>(energy.element_count(), 1e5),
                        std::vector<double>(energy.element_count(), kTheta));
    energy.set_gravity(0);
    energy.set_damping(0);
    const Eigen::AngleAxisd turn(1.2, Vec3(1, -2, 0.5).normalized());
    std::vector<Twin::Vec> x, gradient;
    for (const Vec3& p : mesh.nodes) {
        const Vec3 q = turn * (kTheta * p) + Vec3(0.1, 0.2, 0.3);
        x.emplace_back(q.x(), q.y(), q.z(), 0);
    }
    EXPECT_NEAR(energy.evaluate(x, gradient, 60), 0, 1e-15);
    for (const auto& g : gradient) EXPECT_LT(g.norm(), 1e-9);
    energy.set_material(std::vector<double>(energy.element_count(), 1e5),
                        std::vector<double>(energy.element_count(), 1.0));
    EXPECT_GT(energy.evaluate(x, gradient, 60), 1e-3);
}

TEST(FleshEnergy, SinglePrecisionAgreesWithItsTwin) {
    const FleshMesh mesh = small_mesh();
    Twin twin(mesh, 1000);
    FleshEnergy<float> energy(mesh, 1000);
    const std::vector<double> modulus(energy.element_count(), 5e4), theta(energy.element_count(), 0.9);
    twin.set_material(modulus, theta);
    energy.set_material(modulus, theta);
    const auto x = disturbed(mesh, 1e-3);
    std::vector<Eigen::Vector4f> single;
    for (const auto& p : x) single.emplace_back(p.cast<float>());
    std::vector<Twin::Vec> expected;
    std::vector<Eigen::Vector4f> gradient;
    const double expected_energy = twin.evaluate(x, expected, 20);
    EXPECT_NEAR(energy.evaluate(single, gradient, 20), expected_energy, 1e-5 * expected_energy);
    double largest = 0;
    for (const auto& g : expected) largest = std::max(largest, g.norm());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_LT((gradient[i].cast<double>() - expected[i]).norm(), 1e-4 * largest);
}

TEST(FleshPreconditioner, SolvesItsOwnMatrix) {
    const FleshMesh mesh = small_mesh();
    FleshPreconditioner preconditioner(mesh);
    std::vector<float> weights, diagonal;
    for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e)
        weights.push_back(1e-8F * (1 + 0.5F * std::sin(static_cast<float>(e))));
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        diagonal.push_back(5e-4F + 2e-4F * std::cos(static_cast<float>(i)));
    preconditioner.factorise(weights, diagonal);
    std::vector<Eigen::Vector4f> known, right(mesh.nodes.size(), Eigen::Vector4f::Zero()), solved;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        known.emplace_back(std::sin(1.0F * i), std::cos(2.0F * i), std::sin(0.3F * i), 0.0F);
    for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e) {
        const Tetrahedron& t = mesh.tetrahedra[e];
        Eigen::Matrix3d D;
        for (int k = 0; k < 3; ++k) D.col(k) = mesh.nodes[t[k + 1]] - mesh.nodes[t[0]];
        Eigen::Matrix<double, 4, 3> gradients;
        gradients.bottomRows<3>() = D.inverse();
        gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
        const Eigen::Matrix4f local = (weights[e] * gradients * gradients.transpose()).cast<float>();
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) right[t[a]] += local(a, b) * known[t[b]];
    }
    for (std::size_t i = 0; i < known.size(); ++i) right[i] += diagonal[i] * known[i];
    preconditioner.solve(right, solved);
    for (std::size_t i = 0; i < known.size(); ++i) EXPECT_LT((solved[i] - known[i]).norm(), 1e-4F) << i;
    weights[5] = std::nanf("");
    EXPECT_THROW(preconditioner.factorise(weights, diagonal), RunError);
}

TEST(FleshSolver, NoStepRaisesTheEnergyHoweverHardTheLoad) {
    const FleshMesh mesh = small_mesh();
    FleshSolver solver(mesh, 1000);
    auto& energy = solver.energy();
    energy.set_planes(std::vector<ContactPlane>(energy.surface_count(), {{0, 0, 1}, -0.028F}), {});
    const std::vector<double> theta_of_frame = {1, 0.5, 1, 0.6, 0.95, 0.5};
    std::vector<Eigen::Vector4f> gradient;
    int taken = 0;
    for (std::size_t frame = 0; frame < theta_of_frame.size(); ++frame) {
        energy.set_material(std::vector<double>(energy.element_count(), 2e3),
                            std::vector<double>(energy.element_count(), theta_of_frame[frame]));
        solver.begin_frame();
        for (int step = 0; step < 10; ++step) {
            const double before = energy.evaluate(solver.positions(), gradient, 20);
            taken += solver.descend(1, 1, 0);
            const double after = energy.evaluate(solver.positions(), gradient, 20);
            EXPECT_LE(after, before + 1e-6 * std::abs(before)) << frame << " " << step;
        }
    }
    EXPECT_GT(taken, 30);
    EXPECT_EQ(energy.inverted(solver.positions()), 0);
}

}  // namespace
}  // namespace windfall::decay
