#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/path_tracer.h"
#include "picture/stage.h"
#include "picture/surfaces.h"
#include "synthetic_fruit.h"

namespace windfall::picture {
namespace {

/// A white sphere in a white sky: every direction brings 1, so nothing but 1 may be seen.
Scene furnace() {
    const auto mesh = test::cubed_sphere(16);
    const Refinement refinement(mesh.rest.faces, mesh.rest.positions.size(), 2);
    Channels coarse(static_cast<Eigen::Index>(mesh.rest.positions.size()), 3);
    for (std::size_t v = 0; v < mesh.rest.positions.size(); ++v)
        coarse.row(static_cast<Eigen::Index>(v)) = mesh.rest.positions[v].cast<float>().transpose();
    const Channels fine = refinement.apply(coarse);
    Scene scene;
    SceneMesh sphere;
    sphere.quads = refinement.quads();
    for (Eigen::Index row = 0; row < fine.rows(); ++row)
        sphere.positions.emplace_back(fine.row(row).transpose());
    sphere.normals = smooth_normals(sphere.positions, sphere.quads);
    sphere.albedo.assign(sphere.positions.size(), Vec3f::Ones());
    sphere.finishes[0].gloss = 0;
    scene.meshes.push_back(sphere);
    scene.has_floor = false;
    scene.backdrop_top = scene.backdrop_bottom = Vec3f::Ones();
    scene.camera = frame_sphere(Vec3f::Zero(), 1, 20, 10);
    return scene;
}

RenderSettings small(int size, int samples) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.samples = samples;
    settings.denoise = false;
    return settings;
}

float mean_green(const Image& image) {
    float sum = 0;
    for (const auto& pixel : image.pixels) sum += pixel[1];
    return sum / static_cast<float>(image.pixels.size());
}

Scene studio(int n = 16) {
    const auto mesh = test::cubed_sphere(n);
    StageSettings settings;
    settings.picture_size = 48;
    settings.final_shrinkage = 0.3;
    return Stage({mesh}, settings).scene_of(test::wrinkled(mesh, 0, 0.25));
}

TEST(PictureRender, WhiteSphereVanishesInWhiteSky) {
    const Image image = render(furnace(), small(32, 16));
    for (const auto& pixel : image.pixels)
        for (const float channel : pixel) EXPECT_NEAR(channel, 1, 0.02);
}

TEST(PictureRender, WhiteSphereInASkyLitByADiscKeepsItsEnergy) {
    // An even sky of 1/2 and six wide discs along the axes give a sphere's mean irradiance in closed form:
    // pi/2 from the sky, and a quarter of each disc's irradiance (the cosine averaged over the sphere).
    Scene scene = furnace();
    scene.sky = {Vec3f::Constant(0.5F), Vec3f::Constant(0.5F), Vec3f::Constant(0.5F)};
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0F, 1.0F})
            scene.lights.push_back({side * Vec3f::Unit(axis), 10, Vec3f::Constant(0.3F)});
    const float expected = 0.5F + 6 * 0.3F / 4 / 3.14159265F;
    scene.backdrop_top = scene.backdrop_bottom = Vec3f::Constant(expected);
    EXPECT_NEAR(mean_green(render(scene, small(48, 64))), expected, 0.02 * expected);
}

TEST(PictureRender, ClearCoatNeitherMakesNorLosesMuchLight) {
    for (const float roughness : {0.1F, 0.4F, 0.8F}) {
        Scene scene = furnace();
        scene.meshes[0].finishes[0].gloss = 1;
        scene.meshes[0].finishes[0].roughness = roughness;
        const float mean = mean_green(render(scene, small(32, 64)));
        EXPECT_LT(mean, 1.01) << roughness;
        EXPECT_GT(mean, 0.93) << roughness;
    }
}

TEST(PictureRender, SoftSkinKeepsItsEnergyInEveryColour) {
    Scene scene = furnace();
    scene.meshes[0].finishes[0].scatter = Vec3f(0.1F, 0.04F, 0.02F);
    const Image image = render(scene, small(32, 64));
    for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (const auto& pixel : image.pixels) sum += pixel[c];
        EXPECT_NEAR(sum / static_cast<float>(image.pixels.size()), 1, 0.02) << c;
    }
}

TEST(PictureRender, FruitCastsAShadowOnTheFloor) {
    const Image image = render(studio(), small(48, 16));
    Scene empty = studio();
    empty.meshes[0].quads.clear();
    const Image open = render(empty, small(48, 16));
    const auto darkest = [](const Image& i) {  // in the lowest rows, below the fruit
        float least = 10;
        for (int y = 44; y < 48; ++y)
            for (int x = 0; x < 48; ++x) least = std::min(least, i.at(x, y)[1]);
        return least;
    };
    EXPECT_LT(darkest(image), 0.9F * darkest(open));
}

TEST(PictureRender, SameBitsOnOneAndTwoThreads) {
    const Scene scene = studio();
    RenderSettings settings = small(64, 9);
    settings.denoise = true;
    Image one, two;
    {
        const ThreadLimit limit(1);
        one = render(scene, settings);
    }
    {
        const ThreadLimit limit(2);
        two = render(scene, settings);
    }
    EXPECT_EQ(one.pixels, two.pixels);
    settings.seed = 1;
    EXPECT_NE(one.pixels, render(scene, settings).pixels);
}

TEST(PictureRender, SurfacesLeaveAllThreadsToTheRays) {
    constexpr auto kThreads = tbb::global_control::max_allowed_parallelism;
    const Scene scene = studio();
    const std::size_t before = tbb::global_control::active_value(kThreads);
    const Surfaces surfaces(scene);
    EXPECT_EQ(tbb::global_control::active_value(kThreads), before);
}

TEST(PictureRender, DenoisingBringsAFewSamplesNearerToMany) {
    const Scene scene = studio();
    const Image truth = render(scene, small(64, 512));
    RenderSettings settings = small(64, 8);
    const auto error = [&](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            sum += std::pow(image.pixels[i][1] - truth.pixels[i][1], 2);
        return sum;
    };
    const double grainy = error(render(scene, settings));
    settings.denoise = true;
    EXPECT_LT(error(render(scene, settings)), 0.7 * grainy);
}

TEST(PictureRender, StopsWhenCancelledAndTellsProgress) {
    std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    EXPECT_THROW(render(studio(), small(32, 4), context), Cancelled);
    cancel = false;
    double last = 0;
    context.on_progress = [&](const Progress& p) {
        EXPECT_GT(p.done, last);
        EXPECT_GE(p.seconds_left, 0);
        last = p.done;
    };
    render(studio(), small(32, 20), context);
    EXPECT_EQ(last, 1);
}

TEST(PictureRender, RefusesSettingsThatCannotBe) {
    const Scene scene = studio(4);
    EXPECT_THROW(render(scene, small(0, 1)), InputError);
    EXPECT_THROW(render(scene, small(100000, 1)), InputError);
    EXPECT_THROW(render(scene, small(8, 0)), InputError);
    RenderSettings settings = small(8, 1);
    settings.bounces = 0;
    EXPECT_THROW(render(scene, settings), InputError);
}

TEST(PictureRender, FrameRestsOnTheFloorInEitherPose) {
    const auto mesh = test::cubed_sphere(8, 1.6);
    for (const Pose pose : {Pose::Standing, Pose::Lying}) {
        StageSettings settings;
        settings.look.pose = pose;
        const Scene scene = Stage({mesh}, settings).scene_of(test::wrinkled(mesh, 0, 0.2));
        Vec3f low = Vec3f::Constant(1e9F), high = -low;
        for (const Vec3f& p : scene.meshes[0].positions) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        EXPECT_NEAR(low.y(), 0, 1e-6);
        const Vec3f size = high - low;
        EXPECT_EQ(size.y() > 1.2F * size.x(), pose == Pose::Standing);
    }
}

TEST(PictureRender, StageRefusesFramesOfAnotherTake) {
    const auto mesh = test::cubed_sphere(4);
    const Stage stage({mesh}, {});
    take::Frame frame = test::wrinkled(mesh, 0, 0.1);
    frame.meshes[0].positions.pop_back();
    EXPECT_THROW(stage.scene_of(frame), InputError);
    frame.meshes.clear();
    EXPECT_THROW(stage.scene_of(frame), InputError);
    EXPECT_THROW(Stage({}, {}), InputError);
}

TEST(PictureRefinement, KeepsASphereRoundAndCountsRight) {
    const auto mesh = test::cubed_sphere(12);
    const Refinement refinement(mesh.rest.faces, mesh.rest.positions.size(), 2);
    EXPECT_EQ(refinement.quads().size(), 16 * mesh.rest.faces.size());
    // closed, genus 0, all quadrilaterals: V = F + 2
    EXPECT_EQ(refinement.vertex_count(), refinement.quads().size() + 2);
    Channels coarse(static_cast<Eigen::Index>(mesh.rest.positions.size()), 4);
    for (std::size_t v = 0; v < mesh.rest.positions.size(); ++v)
        coarse.row(static_cast<Eigen::Index>(v)) << mesh.rest.positions[v].cast<float>().transpose(), 7;
    const Channels fine = refinement.apply(coarse);
    float least = 10, most = 0;
    for (Eigen::Index row = 0; row < fine.rows(); ++row) {
        const float radius = fine.block<1, 3>(row, 0).norm();
        least = std::min(least, radius);
        most = std::max(most, radius);
        EXPECT_NEAR(fine(row, 3), 7, 1e-4);  // weights sum to one
    }
    EXPECT_LT(most - least, 0.002F);
    EXPECT_GT(least, 0.98F);
}

TEST(PictureRefinement, TakesTrianglesAndBoundariesAndRefusesBadFaces) {
    const Refinement triangle({{0, 1, 2, geometry::kNoVertex}}, 3, 1);
    EXPECT_EQ(triangle.quads().size(), 3U);
    Channels corners(3, 3);
    corners << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    EXPECT_TRUE(triangle.apply(corners).allFinite());
    EXPECT_THROW(Refinement({{0, 1, 2, 9}}, 4, 1), InputError);
    EXPECT_THROW(Refinement({{0, -5, 2, 3}}, 4, 1), InputError);
}

}  // namespace
}  // namespace windfall::picture
