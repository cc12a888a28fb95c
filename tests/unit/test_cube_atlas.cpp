#include "geometry/cube_atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "geometry/layered_mesh.h"
#include "support/message_of.h"

namespace windfall::geometry {
namespace {

TEST(CubeAtlas, RefusesSidesThatCannotBe) {
    for (const int side : {0, 62, 65, 4098})
        EXPECT_NE(message_of([&] { CubeAtlas{side}; }), "no error") << side;
    EXPECT_NO_THROW(CubeAtlas{64});
}

TEST(CubeAtlas, ChartsCoverAllButTheGutters) {
    for (const int side : {64, 100, 256}) {
        const CubeAtlas atlas(side);
        std::size_t covered = 0;
        for (const CubeAtlas::Run& run : atlas.runs()) covered += run.end - run.begin;
        EXPECT_EQ(covered, 6U * static_cast<std::size_t>(atlas.chart_width()) * atlas.chart_height());
        std::size_t marked = 0;
        for (std::size_t i = 0; i < atlas.texel_count(); ++i) marked += atlas.covered(i) ? 1 : 0;
        EXPECT_EQ(marked, covered);
        EXPECT_GE(atlas.chart_width(), side / 3 - 4);
    }
}

TEST(CubeAtlas, TexelsComeBackFromTheirDirections) {
    const CubeAtlas atlas(96);
    std::set<int> charts;
    for (std::size_t i = 0; i < atlas.texel_count(); ++i) {
        if (!atlas.covered(i)) continue;
        const Vec3 d = atlas.texel_direction(i);
        ASSERT_NEAR(d.norm(), 1, 1e-12);
        ASSERT_EQ(atlas.texel_at(2.5 * d), i);
        charts.insert(atlas.chart_of(i));
    }
    EXPECT_EQ(charts.size(), 6U);
}

TEST(CubeAtlas, AgreesWithTheBrickInSidesDirectionsAndTextureCoordinates) {
    const CubeAtlas atlas(128);
    const BrickSurface brick = make_brick_surface({4, 4, 4});
    const auto directions = brick_directions(brick, Vec3::Ones());
    const auto uvs = atlas.corner_uvs(brick);
    ASSERT_EQ(uvs.size(), brick.quads.size());
    for (std::size_t q = 0; q < uvs.size(); ++q) {
        const int chart = static_cast<int>(q / 16);
        const Vec2 middle = 0.25 * (uvs[q][0] + uvs[q][1] + uvs[q][2] + uvs[q][3]);
        // v runs up, rows run down.
        const auto x = static_cast<std::size_t>(middle.x() * 128);
        const auto y = static_cast<std::size_t>((1 - middle.y()) * 128);
        ASSERT_EQ(atlas.chart_of(y * 128 + x), chart);
        for (int c = 0; c < 4; ++c) {
            const Vec2 texel(uvs[q][c].x() * 128, (1 - uvs[q][c].y()) * 128);
            const auto [x0, y0] = atlas.chart_origin(chart);
            const Vec3 d = CubeAtlas::direction(chart, (texel.x() - x0) / atlas.chart_width(),
                                                1 - (texel.y() - y0) / atlas.chart_height());
            ASSERT_LT((d - directions[brick.quads[q][c]]).norm(), 1e-12);
        }
        // Counter-clockwise in the texture too, so that charts are not mirrored.
        const Vec2 e = uvs[q][1] - uvs[q][0], f = uvs[q][3] - uvs[q][0];
        ASSERT_GT(e.x() * f.y() - e.y() * f.x(), 0);
    }
}

TEST(CubeAtlas, BleedingLeavesNoSeamForTheFilter) {
    const CubeAtlas atlas(128);
    std::vector<float> map(atlas.texel_count(), -100);
    const auto value = [](const Vec3& d) { return d.x() + 0.5 * d.y() - 0.7 * d.z() + d.x() * d.y(); };
    for (std::size_t i = 0; i < map.size(); ++i)
        if (atlas.covered(i)) map[i] = static_cast<float>(value(atlas.texel_direction(i)));
    const Vec3 on_seam = Vec3(1, 1, 0.2).normalized();
    EXPECT_GT(std::abs(atlas.sample(map, on_seam) - value(on_seam)), 1);
    atlas.bleed(map);
    for (int k = 0; k < 4000; ++k) {
        const Vec3 d = Vec3(std::sin(k * 1.1), std::cos(k * 2.3), std::sin(k * 0.7 + 1)).normalized();
        ASSERT_NEAR(atlas.sample(map, d), value(d), 0.03);
    }
    EXPECT_NEAR(atlas.sample(map, on_seam), value(on_seam), 0.03);
}

TEST(CubeAtlas, BleedsAllChannelsAlike) {
    const CubeAtlas atlas(64);
    std::vector<float> map(2 * atlas.texel_count(), 0);
    for (std::size_t i = 0; i < atlas.texel_count(); ++i) {
        if (!atlas.covered(i)) continue;
        map[2 * i] = 3;
        map[2 * i + 1] = -4;
    }
    atlas.bleed(map, 2);
    for (std::size_t i = 0; i < atlas.texel_count(); ++i) {
        ASSERT_NEAR(map[2 * i], 3, 1e-5);
        ASSERT_NEAR(map[2 * i + 1], -4, 1e-5);
    }
    EXPECT_THROW(atlas.bleed(map, 1), InputError);
}

}  // namespace
}  // namespace windfall::geometry
