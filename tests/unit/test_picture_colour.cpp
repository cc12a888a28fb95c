#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "picture/colouring.h"
#include "picture/look.h"
#include "picture/skin_colour.h"
#include "picture/stage.h"
#include "synthetic_fruit.h"

namespace windfall::picture {
namespace {

using geometry::Vec3;

TEST(PictureColour, CurvatureOfASphereIsOneOverItsRadius) {
    auto mesh = test::cubed_sphere(32).rest;
    for (Vec3& p : mesh.positions) p *= 2.5;
    for (const double h : mean_curvature(mesh.positions, mesh.faces)) EXPECT_NEAR(h, 0.4, 0.02 * 0.4);
}

TEST(PictureColour, CurvatureOfTrianglesIsThatOfQuadrilaterals) {
    auto mesh = test::cubed_sphere(24).rest;
    std::vector<geometry::Face> triangles;
    for (const auto& f : mesh.faces) {
        triangles.push_back({f[0], f[1], f[2], geometry::kNoVertex});
        triangles.push_back({f[0], f[2], f[3], geometry::kNoVertex});
    }
    double sum = 0;
    for (const double h : mean_curvature(mesh.positions, triangles)) sum += h;
    EXPECT_NEAR(sum / static_cast<double>(mesh.positions.size()), 1, 0.02);
}

TEST(PictureColour, CurvatureIsNegativeInADentAndNoneOnASaddle) {
    auto mesh = test::cubed_sphere(48).rest;
    std::size_t bottom = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        Vec3& p = mesh.positions[v];
        if (p.y() > mesh.positions[bottom].y()) bottom = v;
    }
    for (Vec3& p : mesh.positions) {
        const double r_sq = p.x() * p.x() + p.z() * p.z();
        if (p.y() > 0) p.y() -= 0.5 * std::exp(-r_sq / 0.06);
    }
    EXPECT_LT(mean_curvature(mesh.positions, mesh.faces)[bottom], -3);

    geometry::SurfaceMesh saddle;
    constexpr int kSide = 21;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const double x = (i - 10) * 0.05, y = (j - 10) * 0.05;
            saddle.positions.emplace_back(x, y, 2 * (x * x - y * y));
        }
    for (int j = 0; j + 1 < kSide; ++j)
        for (int i = 0; i + 1 < kSide; ++i) {
            const int v = j * kSide + i;
            saddle.faces.push_back({v, v + 1, v + kSide + 1, v + kSide});
        }
    EXPECT_NEAR(mean_curvature(saddle.positions, saddle.faces)[10 * kSide + 10], 0, 1e-9);
}

TEST(PictureColour, DivergingMapIsRedAboveBlueBelowAndWhiteBetween) {
    const auto high = diverging_colour(1), low = diverging_colour(-1), middle = diverging_colour(0);
    EXPECT_GT(high[0], 4 * high[2]);
    EXPECT_GT(low[2], 4 * low[0]);
    EXPECT_EQ(middle[0], middle[2]);
    EXPECT_GT(middle[1], 0.8);
    EXPECT_EQ(diverging_colour(5), high);
}

TEST(PictureColour, RobustMagnitudeLeavesOutTheFewLargest) {
    std::vector<std::vector<double>> sets(2);
    for (int i = 1; i <= 100; ++i) sets[static_cast<std::size_t>(i % 2)].push_back(i % 3 == 0 ? -i : i);
    sets[0].push_back(1e9);
    EXPECT_NEAR(robust_magnitude(sets, 0.9), 91, 1);
    EXPECT_EQ(robust_magnitude({}, 0.9), 1);
}

TEST(PictureColour, NamesOfColourings) {
    EXPECT_EQ(colouring_named("curvature"), Colouring::Curvature);
    try {
        colouring_named("rainbow");
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("curvature"), std::string::npos);
    }
}

TEST(PictureColour, DepthColouringNeedsDepth) {
    const auto mesh = test::cubed_sphere(4);
    auto frame = test::wrinkled(mesh, 0, 0.2);
    const auto values = shown_values(Colouring::Depth, mesh, frame.meshes[0]);
    EXPECT_EQ(values[3], -static_cast<double>(frame.meshes[0].attributes[0].values[3]));
    frame.meshes[0].attributes.clear();
    EXPECT_THROW(shown_values(Colouring::Depth, mesh, frame.meshes[0]), InputError);
}

TEST(PictureColour, MottleSticksToTheFreshSkin) {
    const auto mesh = test::cubed_sphere(8);
    StageSettings settings;
    settings.look.valley = 0;
    settings.look.bloom = 0;
    const Stage stage({mesh}, settings);
    const auto early = stage.scene_of(test::wrinkled(mesh, 0, 0.1)).meshes[0];
    const auto late = stage.scene_of(test::wrinkled(mesh, 1, 0.3)).meshes[0];
    ASSERT_NE(early.positions, late.positions);
    EXPECT_EQ(early.albedo, late.albedo);
    float least = 1, most = 0;
    for (const Vec3f& c : early.albedo) {
        least = std::min(least, c.x());
        most = std::max(most, c.x());
    }
    EXPECT_GT(most, 1.2F * least);  // there is a mottle
}

TEST(PictureColour, ValleysAreDarkerAndRidgesCarryTheBloom) {
    Look look;
    look.mottle = 0;
    look.bloom = 0.5;
    const auto colours = skin_colours(look, {{Vec3f(1, 0, 0), -0.05F, 1}, {Vec3f(1, 0, 0), 0.06F, 1}});
    EXPECT_GT(colours[0].sum(), 2 * colours[1].sum());
    look.valley = look.bloom = 0;
    const auto plain = skin_colours(look, {{Vec3f(1, 0, 0), 0, 1}});
    EXPECT_LT((plain[0] - linear_colour(look.dry_colour)).norm(), 1e-6F);
    const auto fresh = skin_colours(look, {{Vec3f(1, 0, 0), 0, 0}});
    EXPECT_LT((fresh[0] - linear_colour(look.fresh_colour)).norm(), 1e-6F);
}

TEST(PictureLook, TableGoesToJsonAndBack) {
    Look look;
    set_look(look, "look.gloss", 0.25);
    set_look(look, "look.pose", std::string("lying"));
    set_look(look, "look.dry_colour", std::vector<double>{0.1, 0.2, 0.3});
    const Look read = look_from_json(look_to_json(look));
    EXPECT_EQ(read.gloss, 0.25);
    EXPECT_EQ(read.pose, Pose::Lying);
    EXPECT_EQ(read.dry_colour, look.dry_colour);
    EXPECT_EQ(look_to_json(look).size(), look_parameters().entries().size());
    EXPECT_EQ(look_from_json(nullptr).gloss, Look{}.gloss);
    EXPECT_EQ(look_from_json({{"look.of_a_later_version", 3}}).gloss, Look{}.gloss);
    for (const auto& entry : look_parameters().entries()) {
        EXPECT_FALSE(entry.info.needs_run) << entry.info.key;
        EXPECT_EQ(entry.info.problem_with(entry.info.default_value), "") << entry.info.key;
    }
}

TEST(PictureLook, BadValuesAreInputErrors) {
    Look look;
    EXPECT_THROW(set_look(look, "look.glos", 0.5), InputError);
    EXPECT_THROW(set_look(look, "look.gloss", 1.5), InputError);
    EXPECT_THROW(set_look(look, "look.gloss", std::string("much")), InputError);
    EXPECT_THROW(set_look(look, "look.pose", std::string("flying")), InputError);
    EXPECT_THROW(set_look(look, "look.dry_colour", std::vector<double>{0.1, 0.2}), InputError);
    EXPECT_THROW(set_look(look, "look.dry_colour", std::vector<double>{0.1, 0.2, 3}), InputError);
    EXPECT_THROW(look_from_json({{"look.gloss", -1}}), InputError);
    EXPECT_THROW(look_from_json(nlohmann::json::array({1, 2})), InputError);
    EXPECT_THROW(look_from_json({{"look.gloss", nullptr}}), InputError);
}

}  // namespace
}  // namespace windfall::picture
