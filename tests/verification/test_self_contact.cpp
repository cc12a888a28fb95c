// Folds of the skin press on each other and do not pass through: a deep hollow at the stalk end that drying
// closes.
#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.h"
#include "drying/drying_path.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"
#include "geometry/surface_check_crossings.h"

namespace windfall::drying {
namespace {

/// A fruit with a hollow at its north pole whose circles of latitude shrink most. The skin shrinks along, so
/// that no wrinkles come in between.
DryingParameters hollow(double gap) {
    DryingParameters p;
    p.fruit.r5 = 0.95;
    p.fruit.r6 = 0.6;
    p.fruit.r7 = 0.25;
    p.fruit.stone_r1 = p.fruit.stone_r2 = 0.15;
    p.fruit.skin_thickness = 0.06;
    p.drying.shrinkage = 0.4;
    p.drying.skin_fraction = 1;
    p.drying.latitudinal = 2;
    p.drying.radial = p.drying.meridional = 0.2;
    p.mesh.n = 16;
    p.contact.gap = gap;
    return p;
}

DryingPath fruit_with_hollow(double gap) {
    const DryingParameters parameters = hollow(gap);
    geometry::LayeredMesh mesh = make_mesh(parameters, *make_shape(parameters.fruit));
    add_imperfection(mesh, parameters, {});
    return {std::move(mesh), parameters};
}

std::size_t crossings(const DryingPath& path) {
    geometry::TriangleSurface surface;
    const std::vector<geometry::Vec3> nodes = path.positions();
    const auto layers = static_cast<std::size_t>(path.mesh().layers);
    for (std::size_t c = 0; c < path.mesh().columns(); ++c)
        surface.positions.push_back(nodes[(c + 1) * layers - 1]);
    for (const auto& [a, b, c, d] : path.mesh().brick.quads) {
        surface.triangles.push_back({a, b, c});
        surface.triangles.push_back({a, c, d});
    }
    return geometry::self_crossings(surface).size();
}

TEST(SelfContact, FoldsDoNotPassThroughEachOther) {
    DryingPath path = fruit_with_hollow(0.15);
    int pressing = 0;
    path.advance(0.4, {}, [&] {
        pressing = std::max(pressing, path.state().history.back().contacts);
        EXPECT_EQ(crossings(path), 0U) << "at shrinkage " << path.shrinkage();
    });
    EXPECT_GT(pressing, 500);
    EXPECT_EQ(path.shrinkage(), 0.4);
}

TEST(SelfContact, WithoutItTheyDo) {
    DryingPath path = fruit_with_hollow(0);
    path.advance(0.38, {});
    EXPECT_GT(crossings(path), 10U) << "or the test above shows nothing";
}

TEST(SelfContact, ChangesNoBitBeforeTheFirstTouch) {
    DryingPath with = fruit_with_hollow(0.15);
    DryingPath without = fruit_with_hollow(0);
    with.advance(0.2, {});
    without.advance(0.2, {});
    ASSERT_EQ(with.state().history.back().contacts, 0);
    const auto& a = with.state().displacements.front();
    const auto& b = without.state().displacements.front();
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

TEST(SelfContact, SameBitsForAnyThreadCount) {
    std::vector<AlignedArray<double>> results;
    for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        DryingPath path = fruit_with_hollow(0.15);
        path.advance(0.35, {});
        ASSERT_GT(path.state().history.back().contacts, 50);
        results.push_back(path.state().displacements.front());
    }
    EXPECT_EQ(std::memcmp(results[0].data(), results[1].data(), results[0].size() * sizeof(double)), 0);
}

}  // namespace
}  // namespace windfall::drying
