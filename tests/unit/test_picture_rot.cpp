#include <gtest/gtest.h>

#include "picture/hair_curves.h"
#include "picture/path_tracer.h"
#include "picture/refinement.h"
#include "picture/rotten_surface.h"
#include "picture/show_take.h"
#include "picture/stage.h"
#include "picture/texture_lookup.h"
#include "support/rotten_fruit.h"
#include "support/temporary_folder.h"
#include "take/take_writer.h"

namespace windfall::picture {
namespace {

take::FrameMap plain_map(const std::string& name, const std::vector<double>& value) {
    take::FrameMap map;
    map.name = name;
    map.mesh = "skin";
    map.width = map.height = 8;
    map.components = static_cast<int>(value.size());
    for (int texel = 0; texel < 64; ++texel)
        for (const double v : value) map.values.push_back(static_cast<std::uint16_t>(65535 * v));
    return map;
}

/// The ball, red above u = 0.5 and blue below.
take::Frame two_coloured_frame() {
    take::Frame frame = rotten_frame(0, 0, 0, "fungus", 64, rotten_ball(64, 6));
    frame.maps.clear();
    take::FrameMap base = plain_map("base_color", {0, 0, 0});
    for (std::size_t texel = 0; texel < 64; ++texel) base.values[3 * texel + (texel % 8 < 4 ? 2 : 0)] = 65535;
    frame.maps.push_back(base);
    return frame;
}

Scene scene_of(const take::Frame& frame, const Look& look = {}) {
    StageSettings settings;
    settings.picture_size = 48;
    settings.look = look;
    return Stage({rotten_ball(64, 6)}, settings).scene_of(frame);
}

Ray ray_towards_ball(const Scene& scene, const Vec3f& from) {
    Vec3f middle = Vec3f::Zero();
    for (const Vec3f& p : scene.meshes[0].positions) middle += p;
    middle /= static_cast<float>(scene.meshes[0].positions.size());
    return {middle + 0.2F * from.normalized(), -from.normalized()};
}

TEST(RefinedCorners, GoWithTheRefinedQuadrilaterals) {
    // on a flat grid whose place is its texture coordinate both are refined to the same, away from the border
    constexpr int kCells = 6;
    std::vector<geometry::Face> faces;
    std::vector<std::array<geometry::Vec2, 4>> uvs;
    Channels coarse((kCells + 1) * (kCells + 1), 3);
    const auto vertex = [](int i, int j) { return i + (kCells + 1) * j; };
    for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i)
            coarse.row(vertex(i, j)) << static_cast<float>(i), static_cast<float>(j), 0.0F;
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
            uvs.push_back({geometry::Vec2(i, j), geometry::Vec2(i + 1, j), geometry::Vec2(i + 1, j + 1),
                           geometry::Vec2(i, j + 1)});
        }
    for (const int levels : {1, 2, 3}) {
        const Refinement refinement(faces, static_cast<std::size_t>(coarse.rows()), levels);
        const Channels fine = refinement.apply(coarse);
        const auto corners = refined_corners(faces, uvs, levels);
        ASSERT_EQ(corners.size(), refinement.quads().size());
        int compared = 0;
        for (std::size_t q = 0; q < corners.size(); ++q)
            for (std::size_t k = 0; k < 4; ++k) {
                const Eigen::Vector2f place = fine.block<1, 2>(refinement.quads()[q][k], 0).transpose();
                if (place.minCoeff() < 2 || place.maxCoeff() > kCells - 2) continue;
                ASSERT_LT((place - corners[q][k]).norm(), 1e-4F) << levels << " " << q << " " << k;
                ++compared;
            }
        EXPECT_GT(compared, 10);
    }
}

TEST(PictureRot, ColoursComeFromTheMapAtEachRay) {
    const take::Frame frame = two_coloured_frame();
    const Scene scene = scene_of(frame);
    ASSERT_NE(scene.meshes[0].texture, nullptr);
    const Surfaces surfaces(scene);
    const take::TakeMesh mesh = rotten_ball(64, 6);
    int red = 0, blue = 0;
    for (std::size_t f = 0; f < mesh.rest.faces.size(); f += 5) {
        geometry::Vec3 out = geometry::Vec3::Zero();
        double u = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            out += mesh.rest.positions[static_cast<std::size_t>(mesh.rest.faces[f][k])];
            u += mesh.rest.corner_uvs[f][k].x() / 4;
        }
        if (std::abs(u - 0.5) < 0.1) continue;
        const auto hit = surfaces.first_hit(ray_towards_ball(scene, out.cast<float>()));
        ASSERT_TRUE(hit.has_value());
        EXPECT_NEAR(hit->uv.x(), u, 0.05);
        EXPECT_NEAR(hit->albedo.x(), u > 0.5 ? 1 : 0, 1e-3);
        EXPECT_NEAR(hit->albedo.z(), u > 0.5 ? 0 : 1, 1e-3);
        ++(u > 0.5 ? red : blue);
    }
    EXPECT_GT(std::min(red, blue), 5);
}

TEST(PictureRot, MapsSetTheFinishAndTiltTheNormal) {
    take::Frame frame = two_coloured_frame();
    frame.maps.push_back(plain_map("roughness", {0.9}));
    frame.maps.push_back(plain_map("mold_mask", {0.75}));
    frame.maps.push_back(plain_map("normal", {0.8, 0.5, 0.9}));
    Look look;
    look.gloss = 0.8;
    const Scene scene = scene_of(frame, look);
    const Surfaces surfaces(scene);
    auto hit = surfaces.first_hit(ray_towards_ball(scene, Vec3f(0.1F, 0.2F, 1)));
    ASSERT_TRUE(hit.has_value());
    const Vec3f smooth = hit->normal;
    const Vec3f scatter = hit->scatter;
    apply_texture(*hit);
    EXPECT_NEAR(hit->roughness, 0.9F, 1e-3F);
    EXPECT_NEAR(hit->gloss, 0.2F, 1e-3F);
    EXPECT_NEAR((hit->scatter - 0.25F * scatter).norm(), 0, 1e-6F);
    // 0.6 along u, which runs along +x on the side +z, and 0.8 up
    EXPECT_NEAR(hit->normal.dot(smooth), 0.8F, 0.01F);
    EXPECT_GT(hit->normal.x() - smooth.x(), 0.4F);
}

TEST(PictureRot, HairIsSeenAndLetsLightThrough) {
    take::Frame frame = two_coloured_frame();
    take::FrameCurves curves;
    curves.name = "mold";
    curves.mesh = "skin";
    curves.points = {{0, 0, 0.035F}, {0, 0, 0.06F}, {-0.03F, 0, 0.05F}, {0.03F, 0, 0.05F}};
    curves.radii = {1e-3F, 1e-3F};
    curves.colours = {{0.2F, 0.9F, 0.3F}, {0.8F, 0.1F, 0.6F}};
    curves.numbers = {0, 1};
    curves.faces = {0, 0};
    curves.face_places = {{0, 0}, {0, 0}};
    frame.curves.push_back(curves);
    const Scene scene = scene_of(frame);
    const Surfaces surfaces(scene);
    const float y = scene.hair[0].points[0].y();  // the ball stands on the floor
    const auto along = surfaces.first_hit({Vec3f(0.02F, y, 0.2F), -Vec3f::UnitZ()});
    ASSERT_TRUE(along.has_value());
    EXPECT_EQ(along->mesh, nullptr);
    EXPECT_NEAR(along->distance, 0.149F, 1e-4F);
    EXPECT_EQ(along->albedo, Vec3f(0.8F, 0.1F, 0.6F));
    const auto tip = surfaces.first_hit({Vec3f(0, y, 0.2F), -Vec3f::UnitZ()});
    ASSERT_TRUE(tip.has_value());
    EXPECT_EQ(tip->albedo, Vec3f(0.2F, 0.9F, 0.3F));
    EXPECT_FALSE(surfaces.blocked({Vec3f(0.02F, y, 0.2F), -Vec3f::UnitZ(), 0, 0.16F}));
    EXPECT_TRUE(surfaces.blocked({Vec3f(0.02F, y, 0.2F), -Vec3f::UnitZ()}));
    RenderSettings settings;
    settings.width = settings.height = 24;
    settings.samples = 4;
    for (const auto& pixel : render(scene, settings).pixels)
        for (const float part : pixel) ASSERT_TRUE(std::isfinite(part) && part >= 0);
}

TEST(PictureRot, StrandsShorterThanWideAreBalls) {
    take::Frame frame = two_coloured_frame();
    take::FrameCurves heads;
    heads.name = "sporangia";
    heads.mesh = "skin";
    heads.points = {{0.05F, 0, 0}, {0.05003F, 0, 0}};
    heads.radii = {1e-4F};
    heads.colours = {{0.02F, 0.02F, 0.02F}};
    heads.numbers = {0};
    heads.faces = {0};
    heads.face_places = {{0, 0}};
    frame.curves.push_back(heads);
    const Scene scene = scene_of(frame);
    const Surfaces surfaces(scene);
    const float y = scene.hair[0].points[0].y();
    int hits = 0;
    for (int i = -50; i <= 50; ++i)
        for (int j = -50; j <= 50; ++j) {
            const float dx = 1e-5F * static_cast<float>(i), dy = 1e-5F * static_cast<float>(j);
            const auto hit = surfaces.first_hit({Vec3f(0.050015F + dx, y + dy, 0.25F), -Vec3f::UnitZ()});
            if (!hit || hit->mesh != nullptr) continue;
            ++hits;
            EXPECT_LT(std::hypot(dx, dy), 1.1e-4F);
            EXPECT_NEAR(hit->distance, 0.25F, 2e-4F);
        }
    EXPECT_NEAR(hits, 314, 40);  // pi 10^2
}

TEST(PictureRot, ABowlIsNoFruit) {
    take::TakeMesh bowl = rotten_ball(64, 6, "bowl");
    for (auto& p : bowl.rest.positions) p.y() -= 0.05;
    bowl.rest.corner_uvs.clear();
    take::Frame frame = two_coloured_frame();
    take::FrameMesh moved{"bowl", {}, {}};
    for (const auto& p : bowl.rest.positions) moved.positions.emplace_back(p.cast<float>());
    frame.meshes.push_back(moved);
    StageSettings settings;
    settings.picture_size = 48;
    const Scene scene = Stage({rotten_ball(64, 6), bowl}, settings).scene_of(frame);
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_NE(scene.meshes[0].texture, nullptr);
    EXPECT_EQ(scene.meshes[1].texture, nullptr);
    EXPECT_EQ(scene.meshes[1].quads.size(), bowl.rest.faces.size());
    float lowest = 1;
    for (const Vec3f& p : scene.meshes[1].positions) lowest = std::min(lowest, p.y());
    EXPECT_NEAR(lowest, 0, 1e-6F);
}

TEST(PictureRot, APileIsFramedAsItSettledAndItsFleshIsHidden) {
    // both fruit are at the origin in the take's meshes, and side by side in the frames
    std::vector<take::TakeMesh> meshes{rotten_ball(64, 6, "skin_0"), rotten_ball(64, 6, "skin_1"),
                                       rotten_ball(64, 6, "flesh_0")};
    take::Frame frame;
    for (const auto& mesh : meshes) {
        take::FrameMesh moved{mesh.name, {}, {}};
        const float shift = mesh.name == "skin_1" ? 0.07F : 0;
        for (const auto& p : mesh.rest.positions)
            moved.positions.emplace_back(p.cast<float>() + Vec3f(shift, 0, 0));
        frame.meshes.push_back(std::move(moved));
    }
    StageSettings settings;
    settings.picture_size = 48;
    settings.look.pores = 1;
    const Stage stage(meshes, settings, std::span<const take::Frame>(&frame, 1));
    const Scene scene = stage.scene_of(frame);
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_NEAR(scene.camera.target.x(), 0.035, 1e-4);
    EXPECT_GT(scene.camera.distance, 1.8 * scene_of(two_coloured_frame()).camera.distance);
    // the look counts in radii of a fruit, not of the pile
    EXPECT_NEAR(scene.meshes[0].finishes[0].pore_size, settings.look.pore_size * kBallRadius_m, 1e-5);
}

TEST(PictureRot, ShowDressesTheFramesItDraws) {
    const TemporaryFolder folder;
    take::TakeInfo info;
    info.process = "decay";
    info.name = "orange";
    info.parameters = info.look = nlohmann::json::object();
    auto writer = take::TakeWriter::create(folder.path() / "take", info, false);
    writer.add_mesh(rotten_ball(64, 6));
    for (int i = 0; i < 3; ++i)
        writer.add_frame(rotten_frame(i, 0.01 * i, 0, "fungus", 64, rotten_ball(64, 6)));
    ShowOptions options;
    options.kind = ShowKind::SingleFrame;
    options.frame = 1;
    options.size = 16;
    options.samples = 1;
    std::vector<int> dressed;
    options.dress = [&](take::Frame& frame) {
        EXPECT_EQ(frame.maps.size(), 4U);
        EXPECT_FALSE(frame.maps[0].values.empty());
        dressed.push_back(frame.index);
    };
    EXPECT_EQ(show_take(take::TakeReader(folder.path() / "take"), options, {}).pictures.size(), 1U);
    EXPECT_EQ(dressed, std::vector<int>{1});
}

}  // namespace
}  // namespace windfall::picture
