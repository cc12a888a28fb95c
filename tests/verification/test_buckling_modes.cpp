// Linear buckling of the base case (a sphere, stone 0.4, skin 0.04, gamma 10) against what drying it shows.
#include "drying/buckling_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drying/ridges.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

using geometry::LayeredMesh;

struct Buckled {
    LayeredMesh mesh;
    BucklingModes modes;
};

Buckled buckle(int n, int modes, double linearize_at) {
    DryingParameters parameters;
    parameters.mesh.n = n;
    parameters.imperfection.modes = modes;
    parameters.imperfection.linearize_at = linearize_at;
    LayeredMesh mesh = make_mesh(parameters, *make_shape(parameters.fruit));
    BucklingModes found = find_buckling_modes(mesh, parameters, {});
    return {std::move(mesh), std::move(found)};
}

/// Degree l of the spherical harmonic with the mode's root mean square wave number.
double harmonic_degree(const LayeredMesh& mesh, const std::vector<geometry::Vec3>& mode) {
    std::vector<double> depth(mesh.columns());
    for (std::size_t v = 0; v < depth.size(); ++v)
        depth[v] = -mesh.directions[v].dot(mode[(v + 1) * mesh.layers - 1]);
    const auto skin = mesh.level_positions(mesh.layers);
    const double wave_number = 2 * std::numbers::pi / measure_ridges(skin, mesh.faces(), depth).wavelength;
    const double squared = std::pow(wave_number * skin.front().norm(), 2);  // l (l + 1)
    return std::sqrt(squared + 0.25) - 0.5;
}

TEST(BucklingModes, BaseCaseBucklesWhereItsDryingLosesStability) {
    constexpr int kModes = 4;
    const auto [mesh, found] = buckle(24, kModes, 0);
    ASSERT_EQ(found.modes.size(), static_cast<std::size_t>(kModes));
    // Drying finds 0.084 to 0.090.
    EXPECT_GT(found.critical_shrinkage.front(), 0.084);
    EXPECT_LT(found.critical_shrinkage.front(), 0.091);
    double last = 0;
    for (std::size_t m = 0; m < found.modes.size(); ++m) {
        // A sphere's modes of one degree, and of the next ones, buckle almost together.
        EXPECT_GE(found.critical_shrinkage[m], last);
        EXPECT_LT(found.critical_shrinkage[m], 1.02 * found.critical_shrinkage.front());
        last = found.critical_shrinkage[m];
        double largest = 0;
        for (const auto& displacement : found.modes[m])
            largest = std::max(largest, displacement.cwiseAbs().maxCoeff());
        EXPECT_NEAR(largest, 1, 1e-12);
        // 14 to 15 on a fine mesh; edges of 1.7 t_e make the skin stiffer and the waves longer.
        EXPECT_GT(harmonic_degree(mesh, found.modes[m]), 11.5);
        EXPECT_LT(harmonic_degree(mesh, found.modes[m]), 15);
    }
}

TEST(BucklingModes, WhereItIsLinearisedMattersLittle) {
    const double from_afar = buckle(16, 1, 0.045).modes.critical_shrinkage.front();
    const double from_near = buckle(16, 1, 0.085).modes.critical_shrinkage.front();
    EXPECT_NEAR(from_afar, from_near, 0.02 * from_near);
}

}  // namespace
}  // namespace windfall::drying
