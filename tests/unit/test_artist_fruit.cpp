#include "drying/artist_fruit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "drying/artist_skin.h"
#include "drying/drying_path.h"
#include "drying/drying_process.h"
#include "drying/specimen.h"
#include "support/message_of.h"
#include "support/test_surfaces.h"

namespace windfall::drying {
namespace {

using geometry::Vec3;

/// Keeps what a run emits.
class FrameKeeper final : public take::FrameSink {
  public:
    void add_mesh(const take::TakeMesh& its_mesh) override { mesh = its_mesh; }
    void add_frame(const take::Frame& frame) override { frames.push_back(frame); }
    void save_checkpoint(std::span<const std::byte> bytes) override {
        checkpoint.assign(bytes.begin(), bytes.end());
    }
    void set_summary(const nlohmann::json&) override {}

    take::TakeMesh mesh;
    std::vector<take::Frame> frames;
    std::vector<std::byte> checkpoint;
};

/// A mesh by the formula of a test, coarse enough for a unit test.
DryingParameters coarse(double shrinkage) {
    DryingParameters p;
    p.fruit.mesh = "given.obj";
    p.fruit.skin_thickness = 0.08;
    p.mesh.n = 8;
    p.mesh.elongation = 1;
    p.drying.shrinkage = shrinkage;
    p.output.frames = 2;
    return p;
}

TEST(ArtistFruit, LengthsAreOverTheRadiusOfTheBallOfEqualVolume) {
    const auto mesh = test::sphere_mesh(96, 64, 0.02);
    EXPECT_NEAR(equivalent_radius(mesh), 0.02, 2e-5);
    const ArtistFruit fruit({mesh, {}}, coarse(0.1));
    EXPECT_NEAR(fruit.vertices().back().norm(), 1, 1e-3);
}

TEST(ArtistFruit, SkinsTooThickForANeckAreRefusedAndNearlySoToldOf) {
    const auto ball = test::sphere_mesh(48, 32, 0.02);
    FruitParameters fruit;
    fruit.skin_thickness = 0.3;
    EXPECT_THAT(check_thickness(ball, fruit), testing::IsEmpty());
    fruit.skin_thickness = 0.4;
    EXPECT_THAT(check_thickness(ball, fruit), testing::ElementsAre(testing::HasSubstr("skins thick")));
    fruit.skin_thickness = 0.55;
    const std::string text = message_of([&] { check_thickness(ball, fruit); });
    EXPECT_THAT(text, testing::HasSubstr("set fruit.skin_thickness = "));
    EXPECT_THAT(text, testing::HasSubstr(") of fruit.mesh"));
}

TEST(ArtistFruit, EveryStoneIsMeshed) {
    const auto mesh = test::potato_mesh(48, 32);
    DryingParameters p = coarse(0.1);
    const auto core_of = [&](StoneKind kind) {
        p.fruit.stone = kind;
        const ArtistFruit fruit({mesh, test::sphere_mesh(32, 24, 0.015)}, p);
        const geometry::LayeredMesh body = make_mesh(p, fruit);
        EXPECT_GT(worst_corner(body).scaled_jacobian, 0.1);
        return geometry::enclosed_volume(body.base, body.faces()) * std::pow(fruit.r1(), 3);
    };
    const double volume = geometry::enclosed_volume(mesh.positions, mesh.faces);
    EXPECT_LT(core_of(StoneKind::None), 0.03 * volume);
    EXPECT_GT(core_of(StoneKind::Made), 0.05 * volume);
    EXPECT_NEAR(core_of(StoneKind::Mesh), 4 * std::numbers::pi / 3 * std::pow(0.015, 3), 0.1 * 1.4e-5);
    p.fruit.stone_r1 = 0.3;
    p.fruit.stone_r2 = 0.2;
    EXPECT_NEAR(core_of(StoneKind::Ellipsoid), 0.3 * 0.2 * 0.2 * volume, 0.1 * 0.012 * volume);
}

/// A ball that is not in the middle of its file.
geometry::SurfaceMesh ball_aside() {
    geometry::SurfaceMesh mesh = test::sphere_mesh(48, 32, 0.02);
    for (Vec3& p : mesh.positions) p += Vec3(0.1, 0.03, 0);
    return mesh;
}

TEST(ArtistFruit, TextureCoordinatesUnderTheSkinAreTheMeshes) {
    const DryingParameters p = coarse(0.1);
    const ArtistFruit fruit({ball_aside(), {}}, p);
    const geometry::LayeredMesh body = make_mesh(p, fruit);
    const auto uvs = fruit.uvs_under(body);
    ASSERT_EQ(uvs.size(), body.brick.quads.size());
    const auto skin = body.level_positions(body.layers);
    for (std::size_t q = 0; q < uvs.size(); ++q) {
        Vec3 middle = Vec3::Zero();
        for (const std::int32_t v : body.brick.quads[q]) middle += skin[static_cast<std::size_t>(v)] / 4;
        const Vec3 d = (middle * fruit.r1() - Vec3(0.1, 0.03, 0)).normalized();
        EXPECT_NEAR(uvs[q].y(), 0.02 + 0.96 * (std::asin(d.z()) / std::numbers::pi + 0.5), 0.01);
        const double turn = std::atan2(d.y(), d.x()) / (2 * std::numbers::pi);
        if (std::hypot(d.x(), d.y()) > 0.5) {
            EXPECT_NEAR(uvs[q].x(), 0.02 + 0.96 * (turn < 0 ? turn + 1 : turn), 0.01);
        }
    }
}

TEST(ArtistFruit, PaintOverItsTextureAndShadeAboutItsMiddleKeepWater) {
    DryingParameters p = coarse(0.3);
    p.fruit.stone = StoneKind::Ellipsoid;
    p.moisture.hours = 20;
    p.moisture.transpiration_ug_s_m2_pa = 5;
    p.climate.name = water::ClimateName::Constant;
    p.climate.temperature_c = 30;
    p.climate.humidity = 0.4;
    const auto moisture_above_and_below = [&](const SkinPaint& paint) {
        FrameKeeper keeper;
        run(p, {std::make_unique<const ArtistFruit>(ArtistMeshes{ball_aside(), {}}, p), paint}, keeper, {});
        const take::FrameMesh& skin = keeper.frames.back().meshes.front();
        const std::vector<float>& moisture = skin.find("moisture")->values;
        std::array<double, 2> sums{}, counts{};
        for (std::size_t v = 0; v < moisture.size(); ++v) {
            const double z = keeper.mesh.rest.positions[v].z();
            if (std::abs(z) < 0.5) continue;
            sums[z > 0] += moisture[v];
            counts[z > 0] += 1;
        }
        return std::array{sums[1] / counts[1], sums[0] / counts[0]};
    };
    const auto [above, below] =
        moisture_above_and_below([](const geometry::Vec2& uv) { return uv.y() > 0.5 ? 0.0 : 1.0; });
    EXPECT_GT(above, below + 0.02);
    p.moisture.shades = {0, 0, -1, 80, 0};
    const auto [lit, shaded] = moisture_above_and_below({});
    EXPECT_GT(shaded, lit + 0.02);
}

TEST(ArtistSkin, VerticesComeBackExactlyAndBallsShrinkByTheClosedForm) {
    const auto mesh = test::sphere_mesh(40, 28, 0.02);
    DryingParameters p = coarse(0.03);
    p.imperfection.kind = ImperfectionKind::None;
    p.fruit.stone = StoneKind::Ellipsoid;
    p.mesh.n = 16;
    p.material.bulk_ratio = 1000;
    p.solver.newton_tolerance = 1e-3;
    const FruitFiles files{std::make_unique<const ArtistFruit>(ArtistMeshes{mesh, {}}, p), {}};
    const ArtistFruit& fruit = *files.fruit;
    FrameKeeper keeper;
    run(p, files, keeper, {});
    EXPECT_EQ(keeper.mesh.rest.faces, mesh.faces);
    EXPECT_EQ(keeper.mesh.rest.corner_uvs.size(), mesh.faces.size());
    ASSERT_EQ(keeper.frames.size(), 2U);
    const auto& fresh = keeper.frames[0].meshes.front();
    const auto& dry = keeper.frames[1].meshes.front();
    ASSERT_EQ(dry.positions.size(), mesh.positions.size());
    ASSERT_EQ(dry.find("depth")->values.size(), mesh.positions.size());
    // docs/drying.md, closed form: flesh from the stone (0.4) to the skin's inner side.
    const double te = p.fruit.skin_thickness, inner = 1 - te;
    const double shrunk = std::pow(1 - p.drying.shrinkage, 3);
    const double flesh = 0.064 + shrunk * (inner * inner * inner - 0.064);
    const double expected = std::cbrt(flesh + 1 - inner * inner * inner);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_LT((fresh.positions[v].cast<double>() - fruit.vertices()[v]).norm(), 1e-6);
        EXPECT_NEAR(dry.positions[v].norm(), expected * fruit.vertices()[v].norm(), 0.01 * te);
    }
}

TEST(ArtistSkin, RunsGoOnFromACheckpointToTheSameBits) {
    const auto mesh = test::potato_mesh(32, 24);
    const DryingParameters p = coarse(0.02);
    const FruitFiles files{std::make_unique<const ArtistFruit>(ArtistMeshes{mesh, {}}, p), {}};
    FrameKeeper whole, first, second;
    run(p, files, whole, {});
    // Cancelled after the first step: the frame of the fresh fruit and a checkpoint are there.
    RunContext context;
    std::atomic<bool> stop = false;
    context.cancel = &stop;
    context.on_progress = [&](const Progress& progress) {
        if (progress.stage == "drying" && progress.done > 0) stop = true;
    };
    EXPECT_THROW(run(p, files, first, context), Cancelled);
    ASSERT_EQ(first.frames.size(), 1U);
    run(p, files, second, {}, first.checkpoint);
    ASSERT_EQ(second.frames.size(), 1U);
    EXPECT_EQ(second.frames[0].meshes[0].positions, whole.frames[1].meshes[0].positions);
}

TEST(ArtistSkin, TheAtlasHasTheSolversSkin) {
    DryingParameters p = coarse(0.005);
    p.fruit.uvs = TakeSkin::Atlas;
    const FruitFiles files{
        std::make_unique<const ArtistFruit>(ArtistMeshes{test::potato_mesh(32, 24), {}}, p), {}};
    FrameKeeper keeper;
    run(p, files, keeper, {});
    EXPECT_EQ(keeper.mesh.rest.positions.size(), 6U * 8 * 8 + 2);
}

TEST(ArtistSkin, SlowDisplacementsOfABeanAreNoDepth) {
    DryingParameters p = coarse(0.1);
    p.fruit.skin_thickness = 0.04;
    p.mesh.elongation = 2;
    const ArtistFruit fruit({test::bean_mesh(32, 48), {}}, p);
    const geometry::LayeredMesh mesh = make_mesh(p, fruit);
    const std::vector<Vec3> rest = mesh.level_positions(mesh.layers);
    const geometry::SlowField slow(mesh.directions, geometry::vertex_areas(rest, mesh.faces()),
                                   mesh.slow_functions);
    std::vector<Vec3> moved = rest;
    for (std::size_t c = 0; c < rest.size(); ++c) {
        const double thickness = (rest[c] - mesh.base[c]).norm();
        moved[c] = 0.9 * rest[c] - 0.2 * thickness * mesh.outward[c] + Vec3(0.1, 0, 0.3);
    }
    for (const double depth : geometry::depth_below_smooth_surface(slow, rest, moved, mesh.faces()))
        EXPECT_LT(std::abs(depth), 1e-3 * p.fruit.skin_thickness);
}

TEST(ArtistFruit, PlansCountWhatIsSolvedAndTellOfCoarseMeshes) {
    DryingParameters p = coarse(0.1);
    p.fruit.skin_thickness = 0.02;
    p.mesh.n = 0;
    const ArtistFruit fruit({test::sphere_mesh(24, 16), {}}, p);
    const Plan planned = plan(p, fruit);
    EXPECT_GT(planned.n, 80);  // edges of 0.015 on a ball of 4 pi: 96
    EXPECT_LT(planned.n, 110);
    EXPECT_EQ(planned.unknowns, (6 * planned.n * planned.n + 2) * 3 * planned.layers);
    EXPECT_THAT(planned.warnings, testing::Contains(testing::HasSubstr("fruit.mesh has only")));
}

}  // namespace
}  // namespace windfall::drying
