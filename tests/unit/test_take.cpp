#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "support/message_of.h"
#include "support/sample_take.h"
#include "support/temporary_folder.h"
#include "take/take_reader.h"
#include "take/take_writer.h"
#include "take/whole_file.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::byte> some_bytes(std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 37);
    return bytes;
}

void expect_same(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.index, b.index);
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.scalars, b.scalars);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t m = 0; m < a.meshes.size(); ++m) {
        EXPECT_EQ(a.meshes[m].name, b.meshes[m].name);
        EXPECT_EQ(a.meshes[m].positions, b.meshes[m].positions);
        ASSERT_EQ(a.meshes[m].attributes.size(), b.meshes[m].attributes.size());
        for (std::size_t k = 0; k < a.meshes[m].attributes.size(); ++k) {
            EXPECT_EQ(a.meshes[m].attributes[k].name, b.meshes[m].attributes[k].name);
            EXPECT_EQ(a.meshes[m].attributes[k].components, b.meshes[m].attributes[k].components);
            EXPECT_EQ(a.meshes[m].attributes[k].values, b.meshes[m].attributes[k].values);
        }
    }
}

class Take : public testing::Test {
  protected:
    /// A take with three frames, no longer being written.
    void write_sample(bool with_checkpoint) const {
        auto writer = TakeWriter::create(m_path, sample_info(), false);
        emit_sample(writer, 3);
        if (with_checkpoint) writer.save_checkpoint(some_bytes(1000));
        writer.set_summary({{"onset_shrinkage", 0.09}});
        writer.log("a line");
    }
    TemporaryFolder m_folder;
    fs::path m_path = m_folder.path() / "box";
};

TEST_F(Take, ComesBackAsItWasWritten) {
    write_sample(true);
    const TakeReader reader(m_path);
    EXPECT_EQ(reader.status(), TakeStatus::Running);
    const TakeInfo& info = reader.info();
    const TakeInfo wanted = sample_info();
    EXPECT_EQ(info.process, wanted.process);
    EXPECT_EQ(info.name, wanted.name);
    EXPECT_EQ(info.title, wanted.title);
    EXPECT_EQ(info.program_version, wanted.program_version);
    EXPECT_EQ(info.seed, wanted.seed);
    EXPECT_EQ(info.unit_length_m, wanted.unit_length_m);
    EXPECT_EQ(info.parameters, wanted.parameters);
    EXPECT_EQ(info.look, wanted.look);
    EXPECT_EQ(info.recipe_text, wanted.recipe_text);

    ASSERT_EQ(reader.meshes().size(), 1u);
    const TakeMesh mesh = sample_mesh();
    EXPECT_EQ(reader.meshes()[0].name, "skin");
    EXPECT_EQ(reader.meshes()[0].rest.positions, mesh.rest.positions);
    EXPECT_EQ(reader.meshes()[0].rest.faces, mesh.rest.faces);
    EXPECT_EQ(reader.meshes()[0].rest.corner_uvs, mesh.rest.corner_uvs);
    EXPECT_EQ(reader.meshes()[0].attributes[0].values, mesh.attributes[0].values);

    ASSERT_EQ(reader.frame_count(), 3);
    for (int i = 0; i < 3; ++i) expect_same(reader.frame(i), sample_frame(i));
    EXPECT_EQ(reader.summary().at("onset_shrinkage"), 0.09);
    EXPECT_TRUE(reader.has_checkpoint());
    EXPECT_EQ(reader.checkpoint(), some_bytes(1000));
    EXPECT_EQ(read_whole_text(m_path / "log.txt", 100), "a line\n");
}

TEST_F(Take, AScalarThatIsNoNumberComesBackAsNan) {
    auto writer = TakeWriter::create(m_path, sample_info(), false);
    writer.add_mesh(sample_mesh());
    Frame frame = sample_frame(0);
    frame.scalars["wavelength"] = std::numeric_limits<double>::quiet_NaN();
    writer.add_frame(frame);
    EXPECT_TRUE(std::isnan(TakeReader(m_path).frame(0).scalars.at("wavelength")));
}

TEST_F(Take, StatusAndReasonAreKept) {
    auto writer = TakeWriter::create(m_path, sample_info(), false);
    for (const auto status :
         {TakeStatus::Complete, TakeStatus::Cancelled, TakeStatus::Failed, TakeStatus::Running}) {
        writer.set_status(status, to_text(status));
        EXPECT_EQ(TakeReader(m_path).status(), status);
        EXPECT_EQ(TakeReader(m_path).status_reason(), to_text(status));
    }
}

TEST_F(Take, IdenticalRunsGiveIdenticalFiles) {
    write_sample(true);
    const fs::path first = m_path;
    m_path = m_folder.path() / "again";
    write_sample(true);
    int compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(first)) {
        if (!entry.is_regular_file()) continue;
        const auto other = m_path / fs::relative(entry.path(), first);
        EXPECT_EQ(read_whole_file(entry.path(), 1u << 20), read_whole_file(other, 1u << 20)) << other;
        ++compared;
    }
    EXPECT_EQ(compared, 10);  // 3 frames, mesh, checkpoint, take, recipe, summary, log, lock
}

TEST_F(Take, AnExistingTakeIsNotTouchedWithoutForce) {
    write_sample(true);
    EXPECT_THAT(message_of([&] { TakeWriter::create(m_path, sample_info(), false); }),
                AllOf(HasSubstr(m_path.string()), HasSubstr("--resume"), HasSubstr("--force")));
    EXPECT_EQ(TakeReader(m_path).frame_count(), 3);
}

TEST_F(Take, ForceReplacesTheTakeAndSparesOtherFiles) {
    write_sample(true);
    write_whole_file(m_path / "notes.txt", "mine");
    auto info = sample_info();
    info.title = "new";
    TakeWriter::create(m_path, info, true);
    const TakeReader reader(m_path);
    EXPECT_EQ(reader.info().title, "new");
    EXPECT_EQ(reader.frame_count(), 0);
    EXPECT_TRUE(reader.meshes().empty());
    EXPECT_FALSE(reader.has_checkpoint());
    EXPECT_TRUE(reader.summary().empty());
    EXPECT_FALSE(fs::exists(m_path / "log.txt"));
    EXPECT_EQ(read_whole_text(m_path / "notes.txt", 100), "mine");
}

TEST_F(Take, ForceDoesNotReplaceWhatIsNoTake) {
    fs::create_directories(m_path);
    write_whole_file(m_path / "thesis.tex", "years of work");
    for (const bool force : {false, true})
        EXPECT_THAT(message_of([&] { TakeWriter::create(m_path, sample_info(), force); }),
                    AllOf(HasSubstr("not a take"), HasSubstr("thesis.tex")));
    write_whole_file(m_path / "take.json", R"({"name": "another program's"})");
    EXPECT_THAT(message_of([&] { TakeWriter::create(m_path, sample_info(), true); }),
                HasSubstr("not a take"));
    EXPECT_EQ(read_whole_text(m_path / "thesis.tex", 100), "years of work");
    EXPECT_FALSE(fs::exists(m_path / ".lock"));
}

TEST_F(Take, AnEmptyFolderIsTaken) {
    fs::create_directories(m_path);
    write_sample(false);
    EXPECT_EQ(TakeReader(m_path).frame_count(), 3);
}

TEST_F(Take, ResumeGoesOnFromTheCheckpoint) {
    write_sample(true);
    auto info = sample_info();
    info.look = {{"look.gloss", 0.9}};
    auto writer = TakeWriter::resume(m_path, info);
    ASSERT_TRUE(writer.checkpoint().has_value());
    EXPECT_EQ(*writer.checkpoint(), some_bytes(1000));
    writer.add_frame(sample_frame(2));
    writer.add_frame(sample_frame(3));
    const TakeReader reader(m_path);
    EXPECT_EQ(reader.frame_count(), 4);
    EXPECT_EQ(reader.meshes().size(), 1u);
    EXPECT_EQ(reader.info().look.at("look.gloss"), 0.9);
    expect_same(reader.frame(3), sample_frame(3));
}

TEST_F(Take, ResumeWithoutACheckpointBeginsAnew) {
    write_sample(false);
    auto writer = TakeWriter::resume(m_path, sample_info());
    EXPECT_FALSE(writer.checkpoint().has_value());
    EXPECT_EQ(TakeReader(m_path).frame_count(), 0);
    emit_sample(writer, 2);
    EXPECT_EQ(TakeReader(m_path).frame_count(), 2);
}

TEST_F(Take, ResumeNamesTheParameterThatDiffers) {
    write_sample(true);
    auto info = sample_info();
    info.parameters["material.gamma"] = 12.5;
    EXPECT_THAT(message_of([&] { TakeWriter::resume(m_path, info); }),
                HasSubstr("material.gamma is 10.0 in the take and 12.5 in the recipe"));
    info = sample_info();
    info.parameters.erase("mesh.n");
    EXPECT_THAT(message_of([&] { TakeWriter::resume(m_path, info); }),
                HasSubstr("mesh.n is 4 in the take and not set in the recipe"));
    info = sample_info();
    info.seed = 8;
    EXPECT_THAT(message_of([&] { TakeWriter::resume(m_path, info); }),
                HasSubstr("seed is 7 in the take and 8"));
    EXPECT_EQ(TakeReader(m_path).frame_count(), 3);
}

TEST_F(Take, ResumeAndReadRefuseWhatIsNoTake) {
    for (const bool there : {false, true}) {
        if (there) fs::create_directories(m_path);
        EXPECT_THAT(message_of([&] { TakeWriter::resume(m_path, sample_info()); }),
                    HasSubstr("is not a take"));
        EXPECT_THAT(
            message_of([&] { TakeReader reader(m_path); }),
            AllOf(HasSubstr("is not a take"), HasSubstr("windfall dry sphere -o " + m_path.string())));
    }
}

TEST_F(Take, TwoProgramsCannotWriteOneTake) {
    auto writer = std::make_unique<TakeWriter>(TakeWriter::create(m_path, sample_info(), false));
    EXPECT_THAT(message_of([&] { TakeWriter::resume(m_path, sample_info()); }), HasSubstr("another program"));
    EXPECT_THAT(message_of([&] { TakeWriter::create(m_path, sample_info(), true); }),
                HasSubstr("another program"));
    writer.reset();
    EXPECT_NO_THROW(TakeWriter::resume(m_path, sample_info()));
}

TEST_F(Take, FoldersThatCannotBeWrittenAreTold) {
    write_whole_file(m_path, "a file");
    EXPECT_THROW(TakeWriter::create(m_path, sample_info(), false), InputError);
    EXPECT_THROW(TakeWriter::create(m_path / "below", sample_info(), true), InputError);
    EXPECT_THROW(TakeWriter::create("/proc/windfall", sample_info(), false), InputError);
    EXPECT_EQ(read_whole_text(m_path, 100), "a file");
}

TEST_F(Take, AWriteThatFailsNamesFileAndRemedy) {
    auto writer = TakeWriter::create(m_path, sample_info(), false);
    writer.add_mesh(sample_mesh());
    fs::remove_all(m_path / "frames");
    write_whole_file(m_path / "frames", "in the way");
    EXPECT_THAT(message_of<RunError>([&] { writer.add_frame(sample_frame(0)); }),
                AllOf(HasSubstr("frame_0000.wfa"), HasSubstr("--resume")));
}

TEST_F(Take, MeshesAndFramesMustFit) {
    auto writer = TakeWriter::create(m_path, sample_info(), false);
    EXPECT_THROW(writer.add_frame(sample_frame(0)), std::logic_error);
    writer.add_mesh(sample_mesh());
    Frame frame = sample_frame(0);
    frame.meshes[0].positions.pop_back();
    EXPECT_THROW(writer.add_frame(frame), std::logic_error);
    frame = sample_frame(0);
    frame.meshes[0].attributes[0].values.pop_back();
    EXPECT_THROW(writer.add_frame(frame), std::logic_error);
    TakeMesh outside = sample_mesh();
    outside.name = "../skin";
    EXPECT_THROW(writer.add_mesh(outside), std::logic_error);
}

TEST_F(Take, FramesThatAreNotThereAreTold) {
    write_sample(true);
    EXPECT_THAT(message_of([&] { TakeReader(m_path).frame(3); }), HasSubstr("frames 0 to 2"));
    EXPECT_THROW(TakeReader(m_path).frame(-1), InputError);
    fs::remove(m_path / "frames" / "frame_0001.wfa");
    EXPECT_THAT(message_of([&] { TakeReader reader(m_path); }), HasSubstr("frame_0001.wfa is missing"));
}

TEST_F(Take, DamagedAndMisplacedFilesAreTold) {
    write_sample(true);
    const fs::path frames = m_path / "frames";
    fs::copy_file(frames / "frame_0001.wfa", frames / "frame_0002.wfa", fs::copy_options::overwrite_existing);
    EXPECT_THAT(message_of([&] { TakeReader(m_path).frame(2); }), HasSubstr("holds frame 1"));
    fs::copy_file(m_path / "meshes" / "skin.wfa", frames / "frame_0002.wfa",
                  fs::copy_options::overwrite_existing);
    EXPECT_THAT(message_of([&] { TakeReader(m_path).frame(2); }), HasSubstr("not a frame"));
    fs::resize_file(frames / "frame_0001.wfa", 300);
    EXPECT_THAT(message_of([&] { TakeReader(m_path).frame(1); }), HasSubstr("frame_0001.wfa: "));
    write_whole_file(m_path / "summary.json", "{");
    EXPECT_THROW(TakeReader(m_path).summary(), InputError);
    fs::copy_file(frames / "frame_0000.wfa", m_path / "meshes" / "skin.wfa",
                  fs::copy_options::overwrite_existing);
    EXPECT_THAT(message_of([&] { TakeReader reader(m_path); }), HasSubstr("not a mesh"));
}

// Whatever stands in take.json, the reader opens the take or refuses it.
TEST_F(Take, DamagedHeadersAreTold) {
    write_sample(true);
    const std::string sound = read_whole_text(m_path / "take.json", 1u << 20);
    int refused = 0;
    for (std::size_t i = 0; i < sound.size(); ++i) {
        std::string text = sound;
        text[i] = '~';
        write_whole_file(m_path / "take.json", text);
        if (message_of([&] { TakeReader reader(m_path); }) != "no error") ++refused;
    }
    EXPECT_GT(refused, 100);
    for (const char* text : {"", "[]", "{}", "null", "{\"format\": 3}"}) {
        write_whole_file(m_path / "take.json", text);
        EXPECT_THROW(TakeReader reader(m_path), InputError) << text;
    }
    std::string newer = sound;
    newer.replace(newer.find("\"format_version\": 1"), 19, "\"format_version\": 2");
    write_whole_file(m_path / "take.json", newer);
    EXPECT_THAT(message_of([&] { TakeReader reader(m_path); }), HasSubstr("version 2"));
}

TEST_F(Take, AKilledProgramsTemporariesGo) {
    write_sample(true);
    const fs::path left = m_path / "frames" / ".windfall-1-0.tmp";
    write_whole_file(left, "half a frame");
    ASSERT_TRUE(fs::exists(left));
    EXPECT_EQ(TakeReader(m_path).frame_count(), 3);
    TakeWriter::resume(m_path, sample_info());
    EXPECT_FALSE(fs::exists(left));
}

}  // namespace
}  // namespace windfall::take
