#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <sstream>

#include "export/export_take.h"
#include "support/message_of.h"
#include "support/rotten_fruit.h"
#include "support/sample_take.h"
#include "support/temporary_folder.h"
#include "take/map_file.h"
#include "take/take_writer.h"
#include "take/whole_file.h"

namespace windfall::export_ {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint64_t kAnySize = std::uint64_t{1} << 30U;

take::FrameCurves two_strands() {
    take::FrameCurves curves;
    curves.name = "mold";
    curves.mesh = "skin";
    curves.points_per_strand = 3;
    for (int i = 0; i < 6; ++i) curves.points.emplace_back(static_cast<float>(i), 0.5F, -1);
    curves.radii = {0.25F, 0.5F};
    curves.colours = {{1, 0, 0}, {0, 0.5F, 1}};
    curves.numbers = {4, 17};
    curves.faces = {0, 6};
    curves.face_places = {{0.25F, 0.75F}, {0.1F, 0.2F}};
    return curves;
}

class ExportMaps : public testing::Test {
  protected:
    ExportMaps() {
        take::TakeInfo info = sample_info();
        info.name = "orange";
        info.unit_length_m = 0.5;
        auto writer = take::TakeWriter::create(m_take, info, false);
        writer.add_mesh(rotten_ball(64, 4));
        for (int i = 0; i < 2; ++i)
            writer.add_frame(rotten_frame(i, 0.02, 0.01, "fungus", 64, rotten_ball(64, 4)));
    }

    std::vector<fs::path> exported(ExportOptions options) const {
        options.output = m_out;
        return export_take(take::TakeReader(m_take), options, {});
    }
    std::string text(const fs::path& path) const { return take::read_whole_text(m_out / path, kAnySize); }
    static void add_strands(take::Frame& frame) { frame.curves.push_back(two_strands()); }

    TemporaryFolder m_folder;
    fs::path m_take = m_folder.path() / "take";
    fs::path m_out = m_folder.path() / "out";
};

TEST_F(ExportMaps, WritesEveryMapOfEveryFrameAndWhatItsValuesMean) {
    const auto files = exported({.format = ExportFormat::Maps, .scale = 10, .dress = [](take::Frame& frame) {
                                     take::FrameMap map = frame.maps[0];
                                     map.name = "displacement";
                                     map.minimum = -1e-3;
                                     map.maximum = 2e-3;
                                     frame.maps.push_back(map);
                                 }});
    ASSERT_EQ(files.size(), 2U * 5 + 1);
    const take::TakeReader take(m_take);
    const take::FrameMap wanted = take.frame(1).maps[1];
    take::FrameMap map = wanted;
    const fs::path path = m_out / "maps/skin/fungus/0001.png";
    take::decode_map(take::read_whole_file(path, kAnySize), path.string(), map);
    EXPECT_EQ(map.values, wanted.values);

    const auto list = nlohmann::json::parse(text("maps/maps.json"));
    EXPECT_EQ(list.at("first_frame"), 0);
    EXPECT_EQ(list.at("last_frame"), 1);
    ASSERT_EQ(list.at("maps").size(), 5U);
    const auto& displacement = list["maps"][4];
    EXPECT_EQ(displacement.at("files"), "maps/skin/displacement/####.png");
    EXPECT_EQ(displacement.at("unit"), "m");
    EXPECT_DOUBLE_EQ(displacement.at("value_of_0"), -1e-2);
    EXPECT_DOUBLE_EQ(displacement.at("value_of_65535"), 2e-2);
    EXPECT_EQ(list["maps"][0].at("unit"), "1");
}

TEST_F(ExportMaps, OneFrameAloneAndNothingIsOverwritten) {
    EXPECT_EQ(exported({.format = ExportFormat::Maps, .frame = 1}).size(), 5U);
    EXPECT_FALSE(fs::exists(m_out / "maps/skin/fungus/0000.png"));
    EXPECT_THAT(message_of([&] { exported({.format = ExportFormat::Maps, .frame = 1}); }),
                HasSubstr("--force"));
    EXPECT_NO_THROW(exported({.format = ExportFormat::Maps, .frame = 1, .overwrite = true}));
}

TEST_F(ExportMaps, ATakeWithoutMapsHasNone) {
    const fs::path folder = m_folder.path() / "box";
    auto writer = take::TakeWriter::create(folder, sample_info(), false);
    emit_sample(writer, 1);
    EXPECT_THAT(message_of([&] {
                    export_take(take::TakeReader(folder), {.format = ExportFormat::Maps, .output = m_out},
                                {});
                }),
                HasSubstr("no maps"));
}

TEST_F(ExportMaps, ObjHasHairAsLines) {
    exported({.format = ExportFormat::Obj, .frame = 0, .dress = add_strands});
    const std::string obj = text("orange_0000.obj");
    const std::size_t vertices = rotten_ball(64, 4).rest.positions.size();
    EXPECT_THAT(obj, HasSubstr("\no mold\nv 0 0.25 -0.5\nv 0.5 0.25 -0.5\n"));
    EXPECT_THAT(obj,
                HasSubstr("\nl " + std::to_string(vertices + 1) + " " + std::to_string(vertices + 2) + " " +
                          std::to_string(vertices + 3) + "\nl " + std::to_string(vertices + 4) + " "));
    fs::remove_all(m_out);
    exported({.format = ExportFormat::Obj, .frame = 0});
    EXPECT_THAT(text("orange_0000.obj"), testing::Not(HasSubstr("\nl ")));
}

TEST_F(ExportMaps, PlyHasHairInAFileBesideIt) {
    const auto files = exported({.format = ExportFormat::Ply, .frame = 0, .dress = add_strands});
    ASSERT_THAT(files, ElementsAre(m_out / "orange_0000.ply", m_out / "orange_0000_hair.ply"));
    const std::string ply = text("orange_0000_hair.ply");
    EXPECT_THAT(ply, HasSubstr("element vertex 6\n"));
    EXPECT_THAT(ply, HasSubstr("element edge 4\n"));
    const std::size_t head = ply.find("end_header\n") + std::strlen("end_header\n");
    constexpr std::size_t kVertexBytes = 4 * sizeof(float) + 3;
    ASSERT_EQ(ply.size(), head + 6 * kVertexBytes + 4 * 2 * sizeof(std::int32_t));
    float radius = 0;
    std::memcpy(&radius, ply.data() + head + 3 * kVertexBytes + 3 * sizeof(float), sizeof(float));
    EXPECT_EQ(radius, 0.25F);  // 0.5 of the take's unit of 0.5 m
    EXPECT_EQ(static_cast<unsigned char>(ply[head + 4 * sizeof(float)]), 255);
    std::int32_t ends[8];
    std::memcpy(ends, ply.data() + head + 6 * kVertexBytes, sizeof(ends));
    EXPECT_THAT(ends, ElementsAre(0, 1, 1, 2, 3, 4, 4, 5));
}

TEST_F(ExportMaps, AStillGlbHasHairAsLinesAndAnAnimationHasNone) {
    const auto model_of = [](const fs::path& path) {
        tinygltf::Model model;
        std::string error, warning;
        EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path.string()))
            << error;
        EXPECT_EQ(warning, "");
        return model;
    };
    const auto still = model_of(exported({.format = ExportFormat::Glb, .frame = 0, .dress = add_strands})[0]);
    ASSERT_EQ(still.nodes.size(), 2U);
    EXPECT_EQ(still.scenes[0].nodes, (std::vector<int>{0, 1}));
    EXPECT_EQ(still.nodes[1].name, "mold");
    const auto& primitive = still.meshes[static_cast<std::size_t>(still.nodes[1].mesh)].primitives.at(0);
    EXPECT_EQ(primitive.mode, TINYGLTF_MODE_LINE);
    EXPECT_EQ(still.accessors[static_cast<std::size_t>(primitive.indices)].count, 8U);
    EXPECT_EQ(still.accessors[static_cast<std::size_t>(primitive.attributes.at("COLOR_0"))].count, 6U);
    EXPECT_EQ(still.accessors[static_cast<std::size_t>(primitive.attributes.at("_RADIUS"))].count, 6U);
    EXPECT_DOUBLE_EQ(
        still.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))].maxValues[0], 2.5);
    fs::remove_all(m_out);
    EXPECT_EQ(model_of(exported({.format = ExportFormat::Glb, .dress = add_strands})[0]).nodes.size(), 1U);
}

}  // namespace
}  // namespace windfall::export_
