#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "support/message_of.h"
#include "support/sample_take.h"
#include "support/temporary_folder.h"
#include "take/frame_file.h"
#include "take/map_file.h"
#include "take/map_lookup.h"
#include "take/take_reader.h"
#include "take/take_writer.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

FrameMap small_map(const std::string& name, int components, std::uint32_t salt = 1) {
    FrameMap map;
    map.name = name;
    map.mesh = "skin";
    map.width = 37;
    map.height = 23;
    map.components = components;
    map.minimum = -0.25;
    map.maximum = 1.5;
    map.srgb = components == 3;
    for (std::uint32_t i = 0; i < 37 * 23 * static_cast<std::uint32_t>(components); ++i)
        map.values.push_back(static_cast<std::uint16_t>((i * 2654435761U * salt) >> 16U));
    return map;
}

FrameCurves two_strands() {
    FrameCurves curves;
    curves.name = "mold";
    curves.mesh = "skin";
    curves.points_per_strand = 3;
    for (int i = 0; i < 6; ++i) curves.points.emplace_back(0.1F * static_cast<float>(i), 0.5F, -1);
    curves.radii = {1e-3F, 2e-3F};
    curves.colours = {{0.1F, 0.2F, 0.3F}, {1, 1, 1}};
    curves.numbers = {4, 17};
    curves.faces = {0, 6};
    curves.face_places = {{0.25F, 0.75F}, {0.1F, 0.2F}};
    return curves;
}

Frame frame_with_all(int index) {
    Frame frame = sample_frame(index);
    frame.maps = {small_map("fungus", 1), small_map("base_color", 3), small_map("painted", 4)};
    frame.maps[2].mesh.clear();
    frame.curves = {two_strands()};
    return frame;
}

void expect_same_maps(const Frame& a, const Frame& b) {
    ASSERT_EQ(a.maps.size(), b.maps.size());
    for (std::size_t i = 0; i < a.maps.size(); ++i) {
        EXPECT_EQ(a.maps[i].name, b.maps[i].name);
        EXPECT_EQ(a.maps[i].mesh, b.maps[i].mesh);
        EXPECT_EQ(a.maps[i].components, b.maps[i].components);
        EXPECT_EQ(a.maps[i].minimum, b.maps[i].minimum);
        EXPECT_EQ(a.maps[i].maximum, b.maps[i].maximum);
        EXPECT_EQ(a.maps[i].srgb, b.maps[i].srgb);
        EXPECT_EQ(a.maps[i].values, b.maps[i].values);
    }
}

TEST(TakeMaps, MapsAndCurvesComeBackAsTheyWereWritten) {
    const TemporaryFolder folder;
    auto writer = TakeWriter::create(folder.path() / "t", sample_info(), false);
    writer.add_mesh(sample_mesh());
    for (int i = 0; i < 2; ++i) writer.add_frame(frame_with_all(i));
    EXPECT_TRUE(fs::exists(folder.path() / "t/maps/skin/fungus/0001.png"));
    EXPECT_TRUE(fs::exists(folder.path() / "t/maps/painted/0000.png"));

    const TakeReader take(folder.path() / "t");
    const Frame frame = take.frame(1);
    expect_same_maps(frame, frame_with_all(1));
    ASSERT_EQ(frame.curves.size(), 1U);
    const FrameCurves &curves = frame.curves[0], wanted = two_strands();
    EXPECT_EQ(curves.name, wanted.name);
    EXPECT_EQ(curves.mesh, wanted.mesh);
    EXPECT_EQ(curves.points_per_strand, 3);
    EXPECT_EQ(curves.points, wanted.points);
    EXPECT_EQ(curves.radii, wanted.radii);
    EXPECT_EQ(curves.colours, wanted.colours);
    EXPECT_EQ(curves.numbers, wanted.numbers);
    EXPECT_EQ(curves.faces, wanted.faces);
    EXPECT_EQ(curves.face_places, wanted.face_places);

    const Frame light = take.frame_without_map_values(1);
    ASSERT_EQ(light.maps.size(), 3U);
    EXPECT_EQ(light.maps[0].width, 37);
    EXPECT_TRUE(light.maps[0].values.empty());
}

TEST(TakeMaps, AFrameWithoutThemIsWrittenAsBeforeThereWereAny) {
    const ArrayFile file = to_array_file(sample_frame(3));
    EXPECT_EQ(file.meta.size(), 5U);
    EXPECT_FALSE(file.meta.contains("maps"));
    EXPECT_FALSE(file.meta.contains("curves"));
    EXPECT_EQ(file.arrays.size(), 2U);
    const TemporaryFolder folder;
    auto writer = TakeWriter::create(folder.path() / "t", sample_info(), false);
    writer.add_mesh(sample_mesh());
    writer.add_frame(sample_frame(0));
    EXPECT_FALSE(fs::exists(folder.path() / "t/maps"));
}

TEST(TakeMaps, BothEffortsGiveTheSamePicture) {
    const FrameMap map = small_map("fungus", 1);
    for (const auto effort : {MapEffort::Fast, MapEffort::Small}) {
        FrameMap back = map;
        back.values.clear();
        decode_map(encode_map(map, effort), "f", back);
        EXPECT_EQ(back.values, map.values);
    }
}

TEST(TakeMaps, AFrameWhoseMapsCannotBeWrittenIsNotThere) {
    const TemporaryFolder folder;
    auto writer = TakeWriter::create(folder.path() / "t", sample_info(), false);
    writer.add_mesh(sample_mesh());
    writer.add_frame(frame_with_all(0));
    fs::create_directories(folder.path() / "t/maps/skin/base_color/0001.png/x");
    EXPECT_THROW(writer.add_frame(frame_with_all(1)), RunError);
    EXPECT_EQ(TakeReader(folder.path() / "t").frame_count(), 1);
}

TEST(TakeMaps, DamagedOrMissingMapsAreNamed) {
    const TemporaryFolder folder;
    auto writer = TakeWriter::create(folder.path() / "t", sample_info(), false);
    writer.add_mesh(sample_mesh());
    writer.add_frame(frame_with_all(0));
    const fs::path path = folder.path() / "t/maps/skin/fungus/0000.png";
    const TakeReader take(folder.path() / "t");
    fs::resize_file(path, fs::file_size(path) / 2);
    EXPECT_THAT(message_of([&] { take.frame(0); }), HasSubstr("fungus/0000.png"));
    FrameMap other = small_map("fungus", 1);
    other.width = 23;
    other.height = 37;
    write_whole_file(path, encode_map(other));
    EXPECT_THAT(message_of([&] { take.frame(0); }), AllOf(HasSubstr("0000.png"), HasSubstr("37 x 23")));
    fs::remove(path);
    EXPECT_THROW(take.frame(0), InputError);
    EXPECT_NO_THROW(take.frame_without_map_values(0));
}

TEST(TakeMaps, NamesThatLeadOutOfTheTakeAreRefusedBothWays) {
    const TemporaryFolder folder;
    Frame frame = frame_with_all(0);
    frame.maps[0].name = "../fungus";
    EXPECT_THROW(map_files(folder.path(), frame), std::logic_error);
    ArrayFile file = to_array_file(frame_with_all(0));
    file.meta["maps"][0]["mesh"] = "../..";
    EXPECT_THAT(message_of([&] { frame_from(file, "frame_0000.wfa"); }), HasSubstr("../.."));
    frame = frame_with_all(0);
    frame.maps.push_back(frame.maps[0]);
    EXPECT_THROW(map_files(folder.path(), frame), std::logic_error);
}

TEST(TakeMaps, ANewTakeRemovesTheMapsOfTheOldOneAndNothingElse) {
    const TemporaryFolder folder;
    {
        auto writer = TakeWriter::create(folder.path() / "t", sample_info(), false);
        writer.add_mesh(sample_mesh());
        writer.add_frame(frame_with_all(0));
    }
    std::ofstream(folder.path() / "t/maps/skin/fungus/notes.txt") << "mine";
    std::ofstream(folder.path() / "t/maps/skin/fungus/.windfall-1-1.tmp") << "left behind";
    const auto writer = TakeWriter::create(folder.path() / "t", sample_info(), true);
    EXPECT_FALSE(fs::exists(folder.path() / "t/maps/skin/fungus/0000.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "t/maps/skin/fungus/.windfall-1-1.tmp"));
    EXPECT_TRUE(fs::exists(folder.path() / "t/maps/skin/fungus/notes.txt"));
}

TEST(TakeMaps, CurvesThatDoNotFitAreRefusedBothWays) {
    Frame frame = frame_with_all(0);
    frame.curves[0].numbers.pop_back();
    EXPECT_THROW(to_array_file(frame), std::logic_error);
    ArrayFile file = to_array_file(frame_with_all(0));
    file.meta["curves"][0]["points_per_strand"] = 2;
    EXPECT_THAT(message_of([&] { frame_from(file, "frame_0000.wfa"); }),
                AllOf(HasSubstr("frame_0000.wfa"), HasSubstr("mold")));
    file.meta["curves"][0]["points_per_strand"] = 100000;
    EXPECT_THROW(frame_from(file, "f"), InputError);

    const TemporaryFolder folder;
    auto writer = TakeWriter::create(folder.path() / "t", sample_info(), false);
    writer.add_mesh(sample_mesh());
    frame = frame_with_all(0);
    frame.curves[0].faces[1] = 7;  // the box has seven faces
    writer.add_frame(frame);
    EXPECT_THAT(message_of([&] { TakeReader(folder.path() / "t").frame(0); }), HasSubstr("mold"));
}

TEST(TakeMaps, ValuesBetweenTexelsAreBilinearFromTheTop) {
    FrameMap map;
    map.width = 2;
    map.height = 2;
    map.values = {0, 65535, 0, 0};  // bright in the upper right
    EXPECT_FLOAT_EQ(map_value(map, 0.75F, 0.75F), 1);
    EXPECT_FLOAT_EQ(map_value(map, 0.75F, 0.25F), 0);
    EXPECT_FLOAT_EQ(map_value(map, 0.5F, 0.75F), 0.5F);
    EXPECT_FLOAT_EQ(map_value(map, 0.5F, 0.5F), 0.25F);
    EXPECT_FLOAT_EQ(map_value(map, 9, 9), 1);
    EXPECT_FLOAT_EQ(map_value(map, std::nanf(""), 0.9F), 0);
    map.components = 4;
    map.width = map.height = 1;
    map.values = {0, 65535, 13107, 0};
    const auto values = map_values(map, 0.3F, 0.3F);
    EXPECT_FLOAT_EQ(values[1], 1);
    EXPECT_FLOAT_EQ(values[2], 0.2F);
}

TEST(WholeFiles, NoneGetsItsNameWhenOneCannotBeWritten) {
    const TemporaryFolder folder;
    const std::vector<std::byte> bytes(10);
    EXPECT_THROW(write_whole_files({{folder.path() / "a", bytes}, {folder.path() / "none/b", bytes}}),
                 RunError);
    EXPECT_TRUE(fs::is_empty(folder.path()));
    write_whole_files({{folder.path() / "a", bytes}, {folder.path() / "b", bytes}});
    EXPECT_EQ(fs::file_size(folder.path() / "b"), 10U);
}

}  // namespace
}  // namespace windfall::take
