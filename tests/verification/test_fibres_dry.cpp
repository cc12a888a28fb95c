// Fruit with fibres as a whole: a closed form, which way fibres change the shape and turn the wrinkles, and
// that their way is the same every time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "drying/checkpoint.h"
#include "drying/drying_path.h"
#include "drying/element.h"
#include "drying/imperfection.h"
#include "drying/ridges.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

constexpr double kStone = 0.4;
constexpr double kSkin = 0.04;
constexpr double kGamma = 10;

/// The perfect sphere of test_closed_form_sphere.cpp with radial fibres in its flesh. They do not change how
/// it moves, nearly incompressible as it is, but
///   sigma_t - sigma_r = mu (L^2 - L^-4) - E/2 (k^2 - 1) k^2,  k = theta L^-2 / (1 - f s),
/// k being the stretch of the fibres and f their shrinkage over the flesh's.
struct RadialFibres {
    double shrinkage, stiffness, fibre_shrinkage;

    double theta() const { return 1 - shrinkage; }
    double radius(double fresh) const {
        const auto flesh_cubed = [&](double R) {
            return std::pow(kStone, 3) + std::pow(theta(), 3) * (std::pow(R, 3) - std::pow(kStone, 3));
        };
        if (fresh <= 1) return std::cbrt(flesh_cubed(fresh));
        return std::cbrt(flesh_cubed(1) + std::pow(fresh, 3) - 1);
    }
    double stress_difference(double fresh) const {
        const double stretch = radius(fresh) / ((fresh <= 1 ? theta() : 1) * fresh);
        const double isotropic =
            2 * (fresh <= 1 ? 1 : kGamma) * (std::pow(stretch, 2) - std::pow(stretch, -4));
        if (fresh > 1) return isotropic;
        const double fibre = theta() / (stretch * stretch) / (1 - fibre_shrinkage * shrinkage);
        return isotropic - stiffness * 2 / 2 * (fibre * fibre - 1) * fibre * fibre;
    }
    /// By integrating d sigma_r / dr = 2 (sigma_t - sigma_r) / r inwards from the free surface.
    double radial_stress(double fresh) const {
        constexpr int kIntervals = 4000;
        double stress = 0;
        double outer = 1 + kSkin;
        for (int i = 1; i <= kIntervals; ++i) {
            const double inner = 1 + kSkin + (fresh - 1 - kSkin) * i / kIntervals;
            const double middle = 0.5 * (inner + outer);
            stress -= 2 * stress_difference(middle) / radius(middle) * (radius(outer) - radius(inner));
            outer = inner;
        }
        return stress;
    }
};

TEST(FibresDry, RadialStressFollowsTheDifferentialEquation) {
    constexpr double kBulkRatio = 1000;
    const RadialFibres exact{0.06, 5, 0.3};
    DryingParameters p;
    p.material.bulk_ratio = kBulkRatio;
    p.solver.viscosity = p.solver.late_viscosity = 0;
    p.solver.newton_tolerance = 1e-3;
    p.fibres = {FibreDirection::Radial, FibreLayer::Flesh, exact.stiffness, exact.fibre_shrinkage};
    DryingPath path(geometry::make_layered_mesh(geometry::SphereShape(1, kStone), kSkin, {16, 16, 16},
                                                geometry::graded_layers(14, 2, 1.1)),
                    p);
    path.advance(exact.shrinkage, {});
    const geometry::LayeredMesh& mesh = path.mesh();
    geometry::LayeredMesh now = mesh;
    now.nodes = path.positions();
    const double largest = std::abs(exact.radial_stress(kStone));
    // The fibres are most of it near the stone.
    ASSERT_GT(std::abs((RadialFibres{0.06, 0, 1}.radial_stress(kStone)) - exact.radial_stress(kStone)),
              0.3 * largest);
    for (int k = 0; k < mesh.layers; ++k) {
        const auto layer = static_cast<std::size_t>(k);
        double mean = 0;
        double volume = 0;
        for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q) {
            const Eigen::Matrix3d drying = path.drying_field()(q, k);
            const HexState state =
                hexahedron_state(element_nodes(mesh, q, k), element_nodes(now, q, k),
                                 {path.moduli().shear[layer], path.moduli().bulk[layer], drying,
                                  path.fibres().relaxed(q, drying), path.fibres().moduli[layer]});
            Eigen::Vector3d radial = Eigen::Vector3d::Zero();
            for (const auto v : mesh.brick.quads[q]) radial += mesh.directions[static_cast<std::size_t>(v)];
            radial.normalize();
            mean += state.volume * radial.dot(state.stress * radial);
            volume += state.volume;
        }
        const double middle = 0.5 * (mesh.node(0, k).norm() + mesh.node(0, k + 1).norm());
        EXPECT_NEAR(mean / volume, exact.radial_stress(middle), 0.02 * largest) << "layer " << k;
    }
}

DryingPath sphere(const FibreParameters& fibres, int n, ImperfectionKind imperfection) {
    DryingParameters p;
    p.fruit.skin_thickness = 0.08;
    p.mesh.n = n;
    p.fibres = fibres;
    p.imperfection.kind = imperfection;
    geometry::LayeredMesh mesh = make_mesh(p, *make_shape(p.fruit));
    add_imperfection(mesh, p, {});
    return {std::move(mesh), p};
}

/// Length along the axis over the width, smooth.
double length_over_width(const FibreParameters& fibres) {
    DryingPath path = sphere(fibres, 8, ImperfectionKind::None);
    path.advance(0.1, {});
    geometry::Vec3 extent = geometry::Vec3::Zero();
    for (const geometry::Vec3& p : path.positions()) extent = extent.cwiseMax(p.cwiseAbs());
    return extent.y() / (0.5 * (extent.x() + extent.z()));
}

TEST(FibresDry, FibresThatShrinkLessKeepTheFruitLong) {
    using enum FibreDirection;
    using enum FibreLayer;
    EXPECT_NEAR(length_over_width({}), 1, 1e-3);
    // Along the meridians they keep it long, around the axis wide.
    EXPECT_GT(length_over_width({Meridional, Flesh, 10, 0.3}), 1.01);
    EXPECT_LT(length_over_width({Latitudinal, Flesh, 10, 0.3}), 0.99);
    // Those that dry with the flesh are stretched by stone and skin, which do not, and pull it in.
    EXPECT_LT(length_over_width({Meridional, Flesh, 10, 1}), 1);
    EXPECT_GT(length_over_width({Latitudinal, Flesh, 10, 1}), 1);
}

/// Of the wrinkles past their onset.
double meridian_alignment(const FibreParameters& fibres) {
    DryingPath path = sphere(fibres, 16, ImperfectionKind::Noise);
    path.advance(0.15, {});
    EXPECT_GT(path.onset(), 0);
    const geometry::LayeredMesh& mesh = path.mesh();
    return measure_ridges(mesh.level_positions(mesh.layers), mesh.faces(), path.skin_depth())
        .meridian_alignment;
}

TEST(FibresDry, WrinklesTurnAlongFibresThatShrinkLess) {
    // They leave the skin less to wrinkle for along themselves than across.
    const double without = meridian_alignment({});
    EXPECT_LT(std::abs(without), 0.1);
    EXPECT_GT(meridian_alignment({FibreDirection::Meridional, FibreLayer::Flesh, 10, 0.3}), without + 0.15);
    EXPECT_LT(meridian_alignment({FibreDirection::Latitudinal, FibreLayer::Flesh, 10, 0.3}), without - 0.15);
}

bool same_bits(const AlignedArray<double>& a, const AlignedArray<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

constexpr FibreParameters kBoth{FibreDirection::Meridional, FibreLayer::Both, 5, 0.5};
constexpr double kFirst = 0.06, kThen = 0.1;

TEST(FibresDry, SameBitsOnAnyNumberOfThreadsAndAfterAResume) {
    DryingPath straight = sphere(kBoth, 16, ImperfectionKind::Noise);
    straight.advance(kFirst, {});
    const auto bytes = to_bytes({straight.state(), 2, 1});
    straight.advance(kThen, {});
    ASSERT_GT(straight.onset(), 0) << "the test must pass the bifurcation to mean anything";

    const ThreadLimit limit(1);
    DryingPath resumed = sphere(kBoth, 16, ImperfectionKind::Noise);
    resumed.set_state(checkpoint_from(bytes, resumed.elasticity().size()).path);
    resumed.advance(kThen, {});
    EXPECT_TRUE(same_bits(straight.state().displacements.front(), resumed.state().displacements.front()));

    DryingPath alone = sphere(kBoth, 16, ImperfectionKind::Noise);
    alone.advance(kFirst, {});
    alone.advance(kThen, {});
    EXPECT_TRUE(same_bits(straight.state().displacements.front(), alone.state().displacements.front()));
}

TEST(FibresDry, NoStiffnessHasTheBitsOfNoFibres) {
    FibreParameters limp = kBoth;
    limp.stiffness = 0;
    DryingPath with = sphere(limp, 8, ImperfectionKind::Noise);
    DryingPath without = sphere({}, 8, ImperfectionKind::Noise);
    with.advance(0.03, {});
    without.advance(0.03, {});
    EXPECT_TRUE(same_bits(with.state().displacements.front(), without.state().displacements.front()));
}

}  // namespace
}  // namespace windfall::drying
