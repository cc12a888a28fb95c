#include "geometry/uv_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "geometry/uv_raster.h"
#include "geometry/uv_raster_bake.h"
#include "support/message_of.h"
#include "support/test_surfaces.h"

namespace windfall::geometry {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(UvCheck, SoundCoordinatesHaveNoDefects) {
    for (const auto& [name, mesh] : test::fruit_meshes()) {
        EXPECT_THAT(uv_defects(mesh), IsEmpty()) << name;
        EXPECT_THAT(uv_defects(test::split_vertices(mesh)), IsEmpty()) << name;
        EXPECT_NO_THROW(require_uvs(mesh, name));
    }
}

TEST(UvCheck, ReportsMissingCoordinates) {
    SurfaceMesh mesh = test::sphere_mesh();
    mesh.corner_uvs[1234][2].x() = std::nan("");
    auto defects = uv_defects(mesh);
    ASSERT_EQ(defects.size(), 1U);
    EXPECT_EQ(defects[0].kind, UvDefectKind::Missing);
    EXPECT_THAT(defects[0].faces, testing::ElementsAre(1234));
    mesh.corner_uvs.clear();
    defects = uv_defects(mesh);
    ASSERT_EQ(defects.size(), 1U);
    EXPECT_EQ(defects[0].kind, UvDefectKind::Missing);
    EXPECT_THAT(message_of([&] { require_uvs(mesh, "plum.obj"); }), HasSubstr("plum.obj"));
}

TEST(UvCheck, NamesTheFaceThatLiesOutside) {
    SurfaceMesh mesh = test::sphere_mesh();
    mesh.corner_uvs[77][1] = {1.25, 0.5};
    const auto defects = uv_defects(mesh);
    ASSERT_FALSE(defects.empty());
    EXPECT_EQ(defects[0].kind, UvDefectKind::OutOfRange);
    EXPECT_THAT(defects[0].faces, testing::ElementsAre(77));
    EXPECT_EQ(defects[0].place, Vec2(1.25, 0.5));
    EXPECT_THAT(defects[0].text,
                testing::AllOf(HasSubstr("face 77"), HasSubstr("(1.25, 0.5)"), HasSubstr("UDIM")));
    SurfaceMesh rounded = test::sphere_mesh();
    for (auto& uvs : rounded.corner_uvs)
        for (Vec2& uv : uvs) uv.x() = (uv.x() - 0.02) / 0.96 + 1e-6;  // fills the square, and a little more
    EXPECT_THAT(uv_defects(rounded), IsEmpty());
}

TEST(UvCheck, FindsChartsOnEachOther) {
    // The eastern half of the sphere mirrored onto the western.
    SurfaceMesh mirrored = test::sphere_mesh();
    for (auto& uvs : mirrored.corner_uvs)
        for (Vec2& uv : uvs) uv.x() = std::min(uv.x(), 1 - uv.x());
    const auto defects = uv_defects(mirrored);
    ASSERT_EQ(defects.size(), 1U);
    EXPECT_EQ(defects[0].kind, UvDefectKind::Overlap);
    EXPECT_NEAR(defects[0].place.x(), 0.26, 0.01);
    EXPECT_NEAR(defects[0].place.y(), 0.5, 0.01);
    EXPECT_GT(defects[0].faces.size(), 0.9 * mirrored.faces.size());

    SurfaceMesh one = test::sphere_mesh();
    for (Vec2& uv : one.corner_uvs[20 * 96 + 30]) uv += Vec2(0.3, 0.2);
    const auto lone = uv_defects(one);
    ASSERT_EQ(lone.size(), 1U);
    const Vec2 where(0.02 + 0.96 * 30.5 / 96 + 0.3, 0.02 + 0.96 * 20.5 / 64 + 0.2);
    EXPECT_LT((lone[0].place - where).norm(), 0.01);
    EXPECT_THAT(lone[0].faces, testing::Contains(20 * 96 + 30));
}

TEST(UvCheck, FindsPalettesAndUntouchedDefaults) {
    SurfaceMesh palette = test::sphere_mesh();
    for (auto& uvs : palette.corner_uvs) uvs.fill(Vec2(0.3, 0.7));
    const auto defects = uv_defects(palette);
    ASSERT_EQ(defects.size(), 1U);
    EXPECT_EQ(defects[0].kind, UvDefectKind::NoArea);
    SurfaceMesh reset = test::sphere_mesh();
    for (auto& uvs : reset.corner_uvs) uvs = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    const auto every = uv_defects(reset);
    ASSERT_EQ(every.size(), 1U);
    EXPECT_EQ(every[0].kind, UvDefectKind::Overlap);
    EXPECT_THAT(every[0].text, HasSubstr("6048 times"));
    // The lower half of the sphere twice in the same place.
    SurfaceMesh folded = test::sphere_mesh();
    for (auto& uvs : folded.corner_uvs)
        for (Vec2& uv : uvs) uv.y() = std::min(uv.y(), 1 - uv.y());
    EXPECT_THAT(uv_defects(folded), testing::SizeIs(1));
}

// ---- the raster ----

TEST(UvRaster, ShowsTheRightPlaceInEveryTexel) {
    const SurfaceMesh mesh = test::potato_mesh(48, 32);
    const TriangleSurface surface = welded_triangles(mesh);
    constexpr int kSize = 128;
    const UvRaster raster(mesh, surface, kSize, 0);
    EXPECT_NEAR(static_cast<double>(raster.chart_texels()), 0.96 * 0.96 * kSize * kSize,
                0.04 * kSize * kSize);
    std::size_t covered = 0;
    for (std::size_t texel = 0; texel < raster.texel_count(); ++texel) {
        if (!raster.covered(texel)) continue;
        ++covered;
        const SurfacePlace place = raster.place(texel);
        const auto uvs = uvs_of(mesh, surface.origin[place.triangle]);
        const Vec2 uv = place.weights[0] * uvs[0] + place.weights[1] * uvs[1] + place.weights[2] * uvs[2];
        const std::size_t row = texel / kSize;
        const double x = static_cast<double>(texel % kSize) + 0.5, y = static_cast<double>(row) + 0.5;
        ASSERT_LT((uv - Vec2(x / kSize, 1 - y / kSize)).norm(), 1e-6);
    }
    EXPECT_EQ(covered, raster.chart_texels());
}

TEST(UvRaster, WidensChartsWithThePlacesAtTheirRims) {
    const SurfaceMesh mesh = test::potato_mesh(48, 32);
    const TriangleSurface surface = welded_triangles(mesh);
    const UvRaster bare(mesh, surface, 256, 0), wide(mesh, surface, 256, 3);
    EXPECT_EQ(bare.chart_texels(), wide.chart_texels());
    for (std::size_t y = 40; y < 200; ++y) {
        std::size_t left = 0;
        while (!bare.covered(256 * y + left)) ++left;
        ASSERT_GT(left, 3U);
        for (std::size_t k = 1; k <= 4; ++k) ASSERT_EQ(wide.covered(256 * y + left - k), k <= 3) << y;
        EXPECT_EQ(wide.place(256 * y + left - 2).triangle, bare.place(256 * y + left).triangle);
    }
}

TEST(UvRaster, RefusesSizesThatCannotBeAndMeshesWithoutCoordinates) {
    SurfaceMesh mesh = test::sphere_mesh(24, 16);
    const TriangleSurface surface = welded_triangles(mesh);
    EXPECT_THROW(UvRaster(mesh, surface, 4), InputError);
    EXPECT_THROW(UvRaster(mesh, surface, 100000), InputError);
    mesh.corner_uvs.clear();
    EXPECT_THROW(UvRaster(mesh, surface, 64), InputError);
}

TEST(AtlasBake, BringsAMapOverWithoutSeams) {
    const SurfaceMesh mesh = test::banana_mesh(32, 64);
    const SphereMap map(mesh);
    const UvRaster raster(mesh, map.surface(), 128);
    const CubeAtlas atlas(256);
    const auto value = [](const Vec3& d) { return 2 + std::sin(3 * d.x() + d.y()) * d.z(); };
    std::vector<float> source(atlas.texel_count(), 0.0F);
    for (std::size_t texel = 0; texel < source.size(); ++texel)
        if (atlas.covered(texel)) source[texel] = static_cast<float>(value(atlas.texel_direction(texel)));
    atlas.bleed(source);
    std::vector<float> result(raster.texel_count(), -7.0F);
    const AtlasBake bake(raster, map, atlas);
    bake.bake(source, result);
    double largest = 0;
    for (std::size_t texel = 0; texel < result.size(); ++texel) {
        if (!raster.covered(texel)) {
            ASSERT_EQ(result[texel], -7.0F);
            continue;
        }
        const Vec3 d = map.direction(raster.place(texel));
        ASSERT_NEAR(result[texel], atlas.sample(source, d), 1e-5);
        largest = std::max(largest, std::abs(result[texel] - value(d)));
    }
    EXPECT_LT(largest, 2e-3);
}

TEST(AtlasBake, KeepsChannelsApartAndChecksSizes) {
    const SurfaceMesh mesh = test::sphere_mesh(24, 16);
    const SphereMap map(mesh);
    const UvRaster raster(mesh, map.surface(), 64);
    const CubeAtlas atlas(64);
    const AtlasBake bake(raster, map, atlas);
    std::vector<float> source(3 * atlas.texel_count());
    for (std::size_t i = 0; i < source.size(); ++i) source[i] = static_cast<float>(i % 3 + 1);
    std::vector<float> result(3 * raster.texel_count(), 0.0F);
    bake.bake(source, result, 3);
    ASSERT_GT(raster.chart_texels(), 2000U);
    for (std::size_t texel = 0; texel < raster.texel_count(); ++texel) {
        if (!raster.covered(texel)) continue;
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(result[3 * texel + c], static_cast<float>(c + 1), 1e-5);
    }
    EXPECT_THROW(bake.bake(source, result, 1), InputError);
}

}  // namespace
}  // namespace windfall::geometry
