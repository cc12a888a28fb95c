#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "export/export_take.h"
#include "support/sample_take.h"
#include "support/temporary_folder.h"
#include "take/take_writer.h"
#include "take/whole_file.h"

namespace windfall::export_ {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ExportTake : public testing::Test {
  protected:
    ExportTake() {
        auto writer = take::TakeWriter::create(m_take, sample_info(), false);
        emit_sample(writer, 3);
    }

    std::vector<std::string> exported(const ExportOptions& options) const {
        std::vector<std::string> names;
        for (const auto& path : export_take(take::TakeReader(m_take), options, {})) {
            EXPECT_TRUE(fs::is_regular_file(path)) << path;
            names.push_back(fs::relative(path, m_folder.path()).string());
        }
        return names;
    }

    std::string message(const ExportOptions& options) const {
        try {
            export_take(take::TakeReader(m_take), options, {});
        } catch (const InputError& problem) {
            return problem.what();
        }
        return "no error";
    }

    TemporaryFolder m_folder;
    fs::path m_take = m_folder.path() / "take";
    fs::path m_out = m_folder.path() / "out";
};

using testing::ElementsAre;

TEST_F(ExportTake, NamesFollowTheRequest) {
    EXPECT_THAT(exported({.format = ExportFormat::Obj, .output = m_out}),
                ElementsAre("out/box_0000.obj", "out/box_0001.obj", "out/box_0002.obj"));
    EXPECT_THAT(exported({.format = ExportFormat::Obj, .output = m_folder.path() / "a.obj", .frame = 2}),
                ElementsAre("a.obj"));
    EXPECT_THAT(exported({.format = ExportFormat::Ply, .output = m_out / "b.ply"}),
                ElementsAre("out/b_0000.ply", "out/b_0001.ply", "out/b_0002.ply"));
    EXPECT_THAT(exported({.format = ExportFormat::Ply, .output = m_out, .frame = 1}),
                ElementsAre("out/box_0001.ply"));
    EXPECT_THAT(exported({.format = ExportFormat::Glb, .output = m_out}), ElementsAre("out/box.glb"));
    EXPECT_THAT(exported({.format = ExportFormat::Glb, .output = m_out, .frame = 1}),
                ElementsAre("out/box_0001.glb"));
}

// The first vertex of an OBJ file.
Eigen::Vector3d first_vertex(const fs::path& path) {
    const std::string text = take::read_whole_text(path, 1u << 20);
    std::istringstream line(text.substr(text.find("\nv ") + 3));
    Eigen::Vector3d p;
    line >> p.x() >> p.y() >> p.z();
    return p;
}

TEST_F(ExportTake, LengthsAreMetresTimesTheScale) {
    exported({.format = ExportFormat::Obj, .output = m_out / "a.obj", .frame = 2});
    exported({.format = ExportFormat::Obj, .output = m_out / "b.obj", .frame = 2, .scale = 10});
    const Eigen::Vector3d in_take = sample_frame(2).meshes[0].positions[0].cast<double>();
    EXPECT_LT((first_vertex(m_out / "a.obj") - 0.02 * in_take).norm(), 1e-8);
    EXPECT_LT((first_vertex(m_out / "b.obj") - 0.2 * in_take).norm(), 1e-7);
}

TEST_F(ExportTake, AnimationsCarryTheConstantAttributesOnly) {
    exported({.format = ExportFormat::Glb, .output = m_out / "all.glb"});
    exported({.format = ExportFormat::Glb, .output = m_out / "one.glb", .frame = 1});
    const std::string all = take::read_whole_text(m_out / "all.glb", 1u << 20);
    const std::string one = take::read_whole_text(m_out / "one.glb", 1u << 20);
    EXPECT_THAT(all, testing::AllOf(HasSubstr("\"_DIRECTION\""), testing::Not(HasSubstr("\"_DEPTH\"")),
                                    HasSubstr("\"animations\"")));
    EXPECT_THAT(one, testing::AllOf(HasSubstr("\"_DIRECTION\""), HasSubstr("\"_DEPTH\""),
                                    testing::Not(HasSubstr("\"animations\""))));
}

TEST_F(ExportTake, FilesThatExistAreSparedWithoutForce) {
    fs::create_directories(m_out);
    take::write_whole_file(m_out / "box_0002.obj", "mine");
    ExportOptions options{.format = ExportFormat::Obj, .output = m_out};
    EXPECT_THAT(message(options), testing::AllOf(HasSubstr("box_0002.obj"), HasSubstr("--force")));
    EXPECT_FALSE(fs::exists(m_out / "box_0000.obj"));
    options.overwrite = true;
    EXPECT_EQ(message(options), "no error");
    EXPECT_THAT(take::read_whole_text(m_out / "box_0002.obj", 1u << 20), HasSubstr("\nv "));
}

TEST_F(ExportTake, ImpossibleRequestsAreTold) {
    EXPECT_THAT(message({.output = m_out, .frame = 3}), HasSubstr("frames 0 to 2"));
    EXPECT_THAT(message({.output = m_out, .frame = -1}), HasSubstr("frames 0 to 2"));
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THAT(message({.output = m_out, .scale = bad}), HasSubstr("--scale"));
    EXPECT_THAT(message({.format = ExportFormat::Glb, .output = m_out, .frames_per_second = 0}),
                HasSubstr("--fps"));
    EXPECT_THAT(message({.output = ""}), HasSubstr("-o"));
    EXPECT_THAT(message({.format = ExportFormat::Glb, .output = m_out / "a.obj"}), HasSubstr("--to obj"));
    fs::create_directories(m_out / "d.obj");
    EXPECT_THAT(message({.output = m_out / "d.obj", .frame = 0}), HasSubstr("is a folder"));
    EXPECT_THAT(message({.output = m_take / "take.json" / "below"}), HasSubstr("cannot make the folder"));
    EXPECT_THROW(export_format("stl"), InputError);
    EXPECT_EQ(export_format("glb"), ExportFormat::Glb);
}

TEST_F(ExportTake, ATakeWithoutFramesIsTold) {
    take::TakeWriter::create(m_take, sample_info(), true);
    EXPECT_THAT(message({.output = m_out}), HasSubstr("no frames yet"));
}

TEST_F(ExportTake, PositionsThatAreNoNumbersAreTold) {
    auto writer = take::TakeWriter::create(m_take, sample_info(), true);
    writer.add_mesh(sample_mesh());
    auto frame = sample_frame(0);
    frame.meshes[0].positions[3].y() = std::numeric_limits<float>::quiet_NaN();
    writer.add_frame(frame);
    EXPECT_THAT(message({.output = m_out}), HasSubstr("nowhere"));
}

TEST_F(ExportTake, CancelStopsBetweenFiles) {
    std::atomic<bool> cancel = false;
    RunContext context;
    context.cancel = &cancel;
    context.on_progress = [&](const Progress& p) {
        if (p.done == 1) cancel = true;
    };
    EXPECT_THROW(
        export_take(take::TakeReader(m_take), {.format = ExportFormat::Obj, .output = m_out}, context),
        Cancelled);
    EXPECT_TRUE(fs::exists(m_out / "box_0000.obj"));
    EXPECT_FALSE(fs::exists(m_out / "box_0001.obj"));
}

}  // namespace
}  // namespace windfall::export_
