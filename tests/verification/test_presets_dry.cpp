// Whole runs at the resolution of the presets, against the numbers of docs/drying.md.
#include <gtest/gtest.h>

#include <cmath>

#include "drying/drying_process.h"
#include "drying/frame_maker.h"
#include "drying/ridges.h"
#include "recipe/recipe.h"

namespace windfall::drying {
namespace {

/// Keeps every frame's scalars and what is measured of its ridges.
class Measurer final : public take::FrameSink {
  public:
    struct Row {
        std::map<std::string, double> scalars;
        RidgeMeasures ridges;
    };
    void add_mesh(const take::TakeMesh& mesh) override { m_mesh = mesh; }
    void add_frame(const take::Frame& frame) override {
        const auto& depth = frame.meshes.front().find("depth")->values;
        rows.push_back({frame.scalars, measure_ridges(m_mesh.rest.positions, m_mesh.rest.faces,
                                                      {depth.begin(), depth.end()})});
    }
    void save_checkpoint(std::span<const std::byte>) override {}
    void set_summary(const nlohmann::json& value) override { summary = value; }

    std::vector<Row> rows;
    nlohmann::json summary;

  private:
    take::TakeMesh m_mesh;
};

Measurer dry(const std::string& preset) {
    const recipe::Recipe recipe = recipe::load(preset);
    Measurer measurer;
    run(recipe.drying, measurer, {});
    return measurer;
}

TEST(PresetsDry, SphereIsThePapersBaseCase) {
    const double te = 0.04;
    const Measurer sphere = dry("sphere");
    EXPECT_GE(sphere.summary.at("unknowns").get<int>(), 330000);
    EXPECT_GE(sphere.summary.at("onset_shrinkage").get<double>(), 0.075);
    EXPECT_LE(sphere.summary.at("onset_shrinkage").get<double>(), 0.095);
    const auto& last = sphere.rows.back();
    EXPECT_NEAR(last.scalars.at("shrinkage"), 0.3, 1e-12);
    EXPECT_GE(last.ridges.depth_rms / te, 1.2);
    EXPECT_LE(last.ridges.depth_rms / te, 1.7);
    EXPECT_GE(last.ridges.wavelength / te, 10.5);
    EXPECT_LE(last.ridges.wavelength / te, 14.5);
    for (const auto& row : sphere.rows) {
        const double theta = 1 - row.scalars.at("shrinkage");
        EXPECT_NEAR(row.scalars.at("flesh_volume_ratio") / std::pow(theta, 3), 1, 0.02);
        EXPECT_NEAR(row.scalars.at("skin_volume_ratio"), 1, 0.02);
    }
    // F1: small buckles appear, then merge. Frames are 0.05 apart: the one at 0.1 is the first with wrinkles.
    EXPECT_GT(sphere.rows[2].ridges.valleys, last.ridges.valleys);
    EXPECT_LT(sphere.summary.at("peak_memory_bytes").get<double>(), 2e9);
}

TEST(PresetsDry, ProlateJujubeHasRidgesAlongItsMeridians) {
    EXPECT_GT(dry("jujube").rows.back().ridges.meridian_alignment, 0.3);  // F6
}

TEST(PresetsDry, PlumpJujubeIsReticular) {
    EXPECT_LT(std::abs(dry("jujube-plump").rows.back().ridges.meridian_alignment), 0.2);  // F6
}

}  // namespace
}  // namespace windfall::drying
