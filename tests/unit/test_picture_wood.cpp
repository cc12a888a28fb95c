// Pictures of broken branches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <numbers>
#include <set>

#include "core/error.h"
#include "picture/grain.h"
#include "picture/path_tracer.h"
#include "picture/show_plan.h"
#include "picture/solid_noise.h"
#include "picture/stage.h"
#include "support/message_of.h"
#include "support/synthetic_branch.h"
#include "support/temporary_folder.h"
#include "take/take_writer.h"

namespace windfall::picture {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

take::TakeMesh stub(const std::string& name = "stub", float step = 1) {
    const auto branch = test::synthetic_branch({.length = 4, .step = step, .phloem = 0.2F});
    return test::wood_take_mesh(name, branch,
                                std::vector<Vec3f>(branch.vertex_count(), Vec3f(0.6F, 0.4F, 0.2F)));
}

take::TakeMesh shifted(take::TakeMesh mesh, double x) {
    for (auto& p : mesh.rest.positions) p.x() += x;
    return mesh;
}

/// Where the camera sees a point: -1 .. 1 across the picture, and its depth.
struct Seen {
    double x, y, depth;
};
Seen seen_by(const Camera& camera, const Vec3f& point) {
    const double rad = std::numbers::pi / 180, a = camera.azimuth_deg * rad, e = camera.elevation_deg * rad;
    const Eigen::Vector3d back(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
    const Eigen::Vector3d right(std::cos(a), 0, -std::sin(a)), up = back.cross(right);
    const Eigen::Vector3d d = (point - camera.target).cast<double>();
    const double depth = camera.distance - d.dot(back);
    const double scale = depth * std::tan(camera.vertical_field_of_view_deg * rad / 2);
    return {d.dot(right) / scale, d.dot(up) / scale, depth};
}

// ---- noise and grain ----

void expect_gradient(const std::function<NoiseValue(const Vec3f&)>& noise, const Vec3f& at, float step) {
    const NoiseValue here = noise(at);
    for (int k = 0; k < 3; ++k) {
        const float slope =
            (noise(at + step * Vec3f::Unit(k)).value - noise(at - step * Vec3f::Unit(k)).value) / (2 * step);
        EXPECT_NEAR(here.gradient[k], slope, 0.02F * (1 + here.gradient.norm())) << at.transpose();
    }
}

TEST(PictureGrain, NoiseHasItsOwnGradient) {
    for (int i = 0; i < 40; ++i) {
        const auto t = static_cast<float>(i);
        const Vec3f at(0.31F + 0.77F * t, -3.1F + 0.29F * t, 11.3F - 0.41F * t);
        expect_gradient([](const Vec3f& p) { return solid_noise(p, 7); }, at, 0.004F);
        expect_gradient([](const Vec3f& p) { return fractal_noise(p, Vec3f(2, 0.5F, 1), 3, 7); }, at, 0.002F);
    }
    int smooth = 0;  // cell noise has kinks where the second nearest point changes
    for (int i = 0; i < 40; ++i) {
        const auto t = static_cast<float>(i);
        const Vec3f at(0.31F + 0.77F * t, -3.1F + 0.29F * t, 11.3F - 0.41F * t), step(0.002F, 0, 0);
        const float slope = (cell_noise(at + step, 3).value - cell_noise(at - step, 3).value) / 0.004F;
        smooth += std::abs(slope - cell_noise(at, 3).gradient.x()) < 0.05F ? 1 : 0;
        EXPECT_GE(cell_noise(at, 3).value, 0);
    }
    EXPECT_GE(smooth, 36);
}

TEST(PictureGrain, RunsAlongTheBranch) {
    for (const Grain grain : {Grain::Bark, Grain::Fibres}) {
        double along = 0, across = 0;
        for (int i = 0; i < 400; ++i) {
            const Vec3f at(0.011F * static_cast<float>(i), -0.017F * static_cast<float>(i), 1);
            const float here = grain_at(grain, at).tint.x();
            along += std::abs(grain_at(grain, at + Vec3f(0, 0.005F, 0)).tint.x() - here);
            across += std::abs(grain_at(grain, at + Vec3f(0.005F, 0, 0)).tint.x() - here);
        }
        EXPECT_GT(across, 2.5 * along) << static_cast<int>(grain);
        EXPECT_GT(along, 0);
    }
}

/// A facet of bark hit in its middle, moved from its rest by a rotation and a shift.
GrainValue grain_of_moved_facet(const Eigen::Matrix3f& turn, const Vec3f& shift, Vec3f& tilt) {
    SceneMesh mesh;
    mesh.rest = {Vec3f(1, 0, 0), Vec3f(1, 0.2F, 0), Vec3f(1, 0, 0.2F)};
    for (const Vec3f& p : mesh.rest) mesh.positions.emplace_back(turn * p + shift);
    mesh.finishes[0].grain = Grain::Bark;
    SurfacePoint point;
    point.mesh = &mesh;
    point.finish = mesh.finishes.data();
    point.corners = {0, 1, 2};
    point.weights = {0.3F, 0.3F, 0.4F};
    point.normal = point.face_normal = turn * Vec3f::UnitX();
    point.albedo = Vec3f::Constant(0.5F);
    apply_grain(point);
    tilt = turn.transpose() * point.normal;  // back to the rest shape
    return {point.albedo, Vec3f::Zero()};
}

TEST(PictureGrain, SticksToWoodThatMovesAndTurns) {
    Vec3f at_rest, moved;
    const Eigen::Matrix3f turn = Eigen::AngleAxisf(1.1F, Vec3f(1, 2, -1).normalized()).toRotationMatrix();
    const GrainValue before = grain_of_moved_facet(Eigen::Matrix3f::Identity(), Vec3f::Zero(), at_rest);
    const GrainValue after = grain_of_moved_facet(turn, Vec3f(3, -2, 5), moved);
    EXPECT_EQ(before.tint, after.tint);
    EXPECT_LT((at_rest - moved).norm(), 1e-4);
    EXPECT_GT((at_rest - Vec3f::UnitX()).norm(), 0.01);  // it is tilted at all
}

// ---- surfaces ----

TEST(PictureWood, FibresAreHardAndBarkIsSmooth) {
    const auto mesh = stub();
    const SceneMesh scene = wood_mesh(mesh, test::wood_frame({mesh}).meshes[0]);
    EXPECT_EQ(scene.quads.size(), mesh.rest.faces.size());  // torn fibres are not refined
    EXPECT_EQ(scene.quad_finishes, mesh.face_materials);
    std::size_t bark = 0;
    for (std::size_t f = 0; f < scene.quads.size(); ++f) {
        const Finish& finish = scene.finishes[scene.quad_finishes[f]];
        const std::string& name = mesh.materials[mesh.face_materials[f]].name;
        EXPECT_EQ(finish.hard, name != "bark" && name != "end_grain");
        EXPECT_EQ(finish.grain == Grain::Bark, name == "bark");
        EXPECT_EQ(finish.gloss, 0);
        if (name != "bark") continue;
        ++bark;
        for (const auto v : scene.quads[f])  // fibres at the rim do not bend the normals of the bark
            EXPECT_LT(std::abs(scene.normals[v].y()), 0.25F);
    }
    EXPECT_GT(bark, 100U);
    EXPECT_EQ(scene.albedo[5], Vec3f(0.6F, 0.4F, 0.2F));
}

TEST(PictureWood, AHardQuadrilateralIsFlatAndASmoothOneIsNot) {
    Scene scene;
    SceneMesh mesh;
    mesh.positions = {Vec3f(-1, -1, 0), Vec3f(1, -1, 0), Vec3f(1, 1, 0), Vec3f(-1, 1, 0)};
    mesh.normals = {Vec3f(-1, 0, 1).normalized(), Vec3f(1, 0, 1).normalized(), Vec3f(1, 0, 1).normalized(),
                    Vec3f(-1, 0, 1).normalized()};
    mesh.albedo.assign(4, Vec3f::Ones());
    mesh.quads = {{0, 1, 2, 3}};
    scene.meshes = {mesh};
    const Ray ray{Vec3f(0.7F, 0.1F, 3), Vec3f(0, 0, -1)};
    EXPECT_GT(Surfaces(scene).first_hit(ray)->normal.x(), 0.3F);
    scene.meshes[0].finishes[0].hard = true;
    EXPECT_LT((Surfaces(scene).first_hit(ray)->normal - Vec3f::UnitZ()).norm(), 1e-6);
    // one corner far up: the half that stays flat keeps its own normal
    scene.meshes[0].positions[2].z() = 5;
    const auto flat = Surfaces(scene).first_hit({Vec3f(-0.6F, -0.6F, 9), Vec3f(0, 0, -1)});
    EXPECT_LT((flat->normal - Vec3f::UnitZ()).norm(), 1e-6);
    EXPECT_LT((flat->face_normal - Vec3f::UnitZ()).norm(), 1e-6);
    const auto steep = Surfaces(scene).first_hit({Vec3f(0.6F, 0.6F, 9), Vec3f(0, 0, -1)});
    EXPECT_LT(steep->face_normal.x(), -0.5F);
    EXPECT_GT(steep->face_normal.dot(steep->normal), 0.9F);
}

TEST(PictureWood, WithoutColoursEveryMaterialHasItsOwn) {
    auto mesh = stub();
    mesh.attributes.clear();
    const SceneMesh scene = wood_mesh(mesh, test::wood_frame({mesh}).meshes[0]);
    EXPECT_LT(luminance(scene.albedo[scene.quads.back()[0]]),
              0.5F * luminance(scene.albedo[0]));  // bark, wood
}

TEST(PictureWood, FramesOfAnotherTakeAreRefused) {
    const auto mesh = stub();
    auto frame = test::wood_frame({mesh});
    frame.meshes[0].positions.pop_back();
    EXPECT_THROW(Stage({mesh}, {}).scene_of(frame), InputError);
    frame = test::wood_frame({mesh});
    frame.meshes[0].positions[3].x() = std::nanf("");
    EXPECT_THROW(Stage({mesh}, {}).scene_of(frame), InputError);
    frame.meshes.clear();
    EXPECT_THROW(Stage({mesh}, {}).scene_of(frame), InputError);
}

// ---- colourings ----

TEST(PictureWood, TissueAndHeightAreShownInColours) {
    const auto mesh = stub();
    const auto moved = test::wood_frame({mesh}).meshes[0];
    const auto tissue = shown_values(Colouring::Tissue, mesh, moved);
    std::set<std::array<float, 3>> colours;
    for (const double value : tissue)
        colours.insert(shown_colour(Colouring::Tissue, value, colour_range(Colouring::Tissue, {})));
    EXPECT_EQ(colours.size(), 5U);
    const std::vector<std::vector<double>> heights{shown_values(Colouring::Height, mesh, moved)};
    const ColourRange range = colour_range(Colouring::Height, heights);
    EXPECT_EQ(range.low, -4);
    EXPECT_GT(range.high, 0.5);
    float before = -1;
    for (double h = range.low; h <= range.high; h += 0.1) {
        const auto c = shown_colour(Colouring::Height, h, range);
        EXPECT_GT(luminance(Vec3f(c[0], c[1], c[2])), before);  // brighter with every step
        before = luminance(Vec3f(c[0], c[1], c[2]));
    }
    auto bare = mesh;
    bare.attributes.clear();
    EXPECT_THAT(message_of([&] { shown_values(Colouring::Tissue, bare, moved); }), HasSubstr("no tissue"));
    EXPECT_THAT(message_of([&] { shown_values(Colouring::Depth, mesh, moved); }), HasSubstr("no depth"));
}

// ---- framing ----

TEST(PictureWood, BothMeshesAreInThePictureFromEverySide) {
    const std::vector<take::TakeMesh> meshes{stub(), shifted(stub("piece"), 2.6)};
    const Stage stage(meshes, {});
    Scene scene = stage.scene_of(test::wood_frame(meshes));
    ASSERT_EQ(scene.meshes.size(), 2U);
    for (const double azimuth : {0.0, 77.0, 200.0})
        for (const double elevation : {10.0, 30.0, 68.0}) {
            stage.aim(scene, azimuth, elevation, View::Whole, Framing::AllSides);
            double most = 0;
            for (const auto& mesh : scene.meshes)
                for (const Vec3f& p : mesh.positions) {
                    const Seen seen = seen_by(scene.camera, p);
                    ASSERT_GT(seen.depth, 0);
                    most = std::max({most, std::abs(seen.x), std::abs(seen.y)});
                }
            EXPECT_LT(most, 1) << azimuth << " " << elevation;
            EXPECT_GT(most, 0.5) << azimuth << " " << elevation;
        }
    EXPECT_NEAR(scene.floor.height, -4, 1e-5);
}

TEST(PictureWood, ATurntableDoesNotWobbleAndOneSideIsSeenFromNearer) {
    const std::vector<take::TakeMesh> meshes{stub(), shifted(stub("piece"), 2.6)};
    const Stage stage(meshes, {});
    Scene scene = stage.scene_of(test::wood_frame(meshes));
    stage.aim(scene, 0, 30, View::Break, Framing::AllSides);
    const Camera front = scene.camera;
    stage.aim(scene, 90, 30, View::Break, Framing::AllSides);
    EXPECT_NEAR(scene.camera.distance, front.distance, 0.02 * front.distance);
    EXPECT_NEAR(scene.camera.target.y(), front.target.y(), 0.05);
    stage.aim(scene, 90, 30, View::Break, Framing::OneSide);  // one stands behind the other
    EXPECT_LT(scene.camera.distance, 0.9 * front.distance);
}

TEST(PictureWood, TheViewOfTheBreakHoldsAllThatIsTornAndLeavesOutTheFoot) {
    const auto mesh = stub();
    const Stage stage({mesh}, {});
    Scene scene = stage.scene_of(test::wood_frame({mesh}));
    stage.aim(scene, 25, 30, View::Whole, Framing::OneSide);
    const double far = scene.camera.distance;
    stage.aim(scene, 25, 30, View::Break, Framing::OneSide);
    EXPECT_LT(scene.camera.distance, 0.8 * far);
    const SceneMesh& wood = scene.meshes[0];
    for (std::size_t f = 0; f < wood.quads.size(); ++f)
        if (mesh.materials[mesh.face_materials[f]].name == "fibres")
            for (const auto v : wood.quads[f]) {
                const Seen seen = seen_by(scene.camera, wood.positions[v]);
                ASSERT_LT(std::max(std::abs(seen.x), std::abs(seen.y)), 1);
            }
    EXPECT_LT(seen_by(scene.camera, Vec3f(0, -4, 0)).y, -1);
}

TEST(PictureWood, FramesThatMoveStayInThePicture) {
    const auto mesh = stub();
    const std::vector<take::Frame> frames{test::wood_frame({mesh}),
                                          test::wood_frame({mesh}, 1, Vec3f(4, -3, 0))};
    const Stage stage({mesh}, {}, frames);
    for (const auto& frame : frames) {
        const Scene scene = stage.scene_of(frame);
        EXPECT_NEAR(scene.floor.height, -7, 1e-5);  // one floor for all of them
        for (const Vec3f& p : scene.meshes[0].positions) {
            const Seen seen = seen_by(scene.camera, p);
            ASSERT_LT(std::max(std::abs(seen.x), std::abs(seen.y)), 1);
        }
    }
}

// ---- what is shown ----

TEST(PictureWood, AStillIsShownFromSeveralSidesAndABreakingOverTime) {
    ShowOptions options;
    const ShowPlan still = plan_show(options, "out", 1, true);
    ASSERT_EQ(still.shots.size(), 6U);
    EXPECT_EQ(still.shots[0].view, View::Break);
    EXPECT_GE(still.shots[0].elevation_deg, 25);
    EXPECT_LE(still.shots[0].elevation_deg, 35);
    EXPECT_EQ(still.shots[1].azimuth_deg - still.shots[0].azimuth_deg, 120);
    EXPECT_EQ(still.shots[2].azimuth_deg - still.shots[0].azimuth_deg, 240);
    EXPECT_GT(still.shots[3].elevation_deg, 60);
    EXPECT_EQ(still.shots[4].view, View::Whole);
    const ShowPlan breaking = plan_show(options, "out", 48, true);
    ASSERT_EQ(breaking.shots.size(), 6U);
    EXPECT_EQ(breaking.shots[5].frame, 47);
    EXPECT_EQ(breaking.shots[5].view, View::Whole);
    const ShowPlan fruit = plan_show(options, "out", 1, false);
    EXPECT_EQ(fruit.shots.size(), 1U);
    EXPECT_EQ(fruit.shots[0].elevation_deg, 22);
    options.kind = ShowKind::SingleFrame;
    EXPECT_EQ(plan_show(options, "out", 1, true).shots[0].view, View::Break);
    options.view = view_named("whole");
    EXPECT_EQ(plan_show(options, "out", 1, true).shots[0].view, View::Whole);
    EXPECT_THROW(view_named("inside"), InputError);
}

class PictureOfWood : public testing::Test {
  protected:
    PictureOfWood() {
        take::TakeInfo info;
        info.process = "fracture";
        info.name = "branch";
        info.parameters = info.look = nlohmann::json::object();
        auto writer = take::TakeWriter::create(m_take, info, false);
        writer.add_mesh(stub());
        writer.add_frame(test::wood_frame({stub()}));
        m_options.size = 32;
        m_options.samples = 2;
        m_options.kind = ShowKind::SingleFrame;
    }
    const TemporaryFolder m_temporary;
    const fs::path m_take = m_temporary.path() / "take";
    ShowOptions m_options;
};

TEST_F(PictureOfWood, IsWrittenInEveryColouring) {
    for (const Colouring colouring :
         {Colouring::Material, Colouring::Tissue, Colouring::Height, Colouring::Curvature}) {
        m_options.colouring = colouring;
        EXPECT_TRUE(fs::exists(show_take(take::TakeReader(m_take), m_options, {}).pictures.at(0)));
    }
    EXPECT_TRUE(fs::exists(m_take / "pictures" / "frame-0000-tissue.png"));
}

TEST_F(PictureOfWood, TheLookOfFruitIsRefused) {
    m_options.look = {{"look.gloss", 0.5}};
    EXPECT_THAT(message_of([&] { show_take(take::TakeReader(m_take), m_options, {}); }),
                testing::AllOf(HasSubstr("look.gloss"), HasSubstr("colours.*")));
    EXPECT_FALSE(fs::exists(m_take / "pictures"));
}

TEST(PictureWood, GrainChangesThePictureAndKeepsItsMeanBrightness) {
    const auto mesh = stub();
    StageSettings settings;
    settings.view = View::Break;
    Scene scene = Stage({mesh}, settings).scene_of(test::wood_frame({mesh}));
    RenderSettings render_settings;
    render_settings.width = render_settings.height = 40;
    render_settings.samples = 16;
    const auto mean = [](const Image& image) {
        double sum = 0;
        for (const auto& pixel : image.pixels) sum += pixel[1];
        return sum / static_cast<double>(image.pixels.size());
    };
    const Image with = render(scene, render_settings);
    for (auto& finish : scene.meshes[0].finishes) finish.grain = Grain::None;
    const Image without = render(scene, render_settings);
    EXPECT_NE(with.pixels, without.pixels);
    EXPECT_NEAR(mean(with), mean(without), 0.12 * mean(without));
}

}  // namespace
}  // namespace windfall::picture
