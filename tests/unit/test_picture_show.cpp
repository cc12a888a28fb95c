#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "picture/contact_sheet.h"
#include "picture/image.h"
#include "picture/look.h"
#include "picture/show_take.h"
#include "support/temporary_folder.h"
#include "synthetic_fruit.h"
#include "take/take_writer.h"
#include "take/whole_file.h"

namespace windfall::picture {
namespace {

namespace fs = std::filesystem;

class PictureShow : public testing::Test {
  protected:
    PictureShow() {
        const auto mesh = test::cubed_sphere(6);
        take::TakeInfo info;
        info.process = "drying";
        info.name = "test";
        info.title = "Test fruit";
        info.parameters = nlohmann::json::object();
        info.look = look_to_json({});
        auto writer = take::TakeWriter::create(m_folder, info, false);
        writer.add_mesh(mesh);
        for (int i = 0; i < 9; ++i) writer.add_frame(test::wrinkled(mesh, i, 0.03 * i));
        m_options.size = 16;
        m_options.samples = 1;
    }

    ShowOutput show() const { return show_take(take::TakeReader(m_folder), m_options, {}); }
    static Image8 read(const fs::path& file) { return decode_png(take::read_whole_file(file, 1U << 24U)); }

    const TemporaryFolder m_temporary;
    const fs::path m_folder = m_temporary.path() / "test.take";
    ShowOptions m_options;
};

TEST_F(PictureShow, ContactSheetStandsInTheTakeAndHasTheRightSize) {
    const ShowOutput output = show();
    ASSERT_EQ(output.pictures.size(), 1U);
    EXPECT_EQ(output.pictures[0], m_folder / "pictures" / "contact-sheet.png");
    const Image8 page = read(output.pictures[0]);
    EXPECT_EQ(page.width, sheet_layout(6, 16).width());
    EXPECT_EQ(page.height, sheet_layout(6, 16).height());
}

TEST_F(PictureShow, PicturesAreReplacedOnlyWhenAsked) {
    show();
    try {
        show();
        FAIL() << "replaced a picture";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("--force"), std::string::npos);
    }
    m_options.overwrite = true;
    EXPECT_NO_THROW(show());
    m_options.overwrite = false;
    m_options.colouring = Colouring::Curvature;  // another name, so nothing is in the way
    EXPECT_EQ(show().pictures[0].filename(), "contact-sheet-curvature.png");
}

TEST_F(PictureShow, LookOfTheTakeCanBeOverridden) {
    m_options.kind = ShowKind::SingleFrame;
    m_options.samples = 4;
    const auto before = read(show().pictures[0]);
    m_options.overwrite = true;
    m_options.look = {{"look.dry_colour", std::vector<double>{0.1, 0.9, 0.1}}};
    EXPECT_NE(read(show().pictures[0]).bytes, before.bytes);
    m_options.look = {{"look.dry_color", std::vector<double>{0.1, 0.9, 0.1}}};
    EXPECT_THROW(show(), InputError);
}

TEST_F(PictureShow, WithoutFfmpegThePicturesAreMadeAndTheNoteSaysWhatToInstall) {
    m_options.kind = ShowKind::Turntable;
    m_options.turntable_views = 3;
    m_options.ffmpeg = "windfall-test-no-such-program";
    const ShowOutput output = show();
    EXPECT_EQ(output.pictures.size(), 3U);
    EXPECT_TRUE(fs::exists(m_folder / "pictures" / "turntable" / "0002.png"));
    EXPECT_TRUE(output.movie.empty());
    EXPECT_NE(output.note.find("install ffmpeg"), std::string::npos);
}

TEST_F(PictureShow, AMovieProgramThatFailsIsARunErrorAndLeavesNoMovie) {
    m_options.kind = ShowKind::TimeLapse;
    m_options.ffmpeg = "false";
    EXPECT_THROW(show(), RunError);
    EXPECT_FALSE(fs::exists(m_folder / "pictures" / "time-lapse.mp4"));
    EXPECT_TRUE(fs::exists(m_folder / "pictures" / "time-lapse" / "0008.png"));
}

TEST_F(PictureShow, MovieIsMadeWhereFfmpegIsInstalled) {
    m_options.kind = ShowKind::TimeLapse;
    m_options.size = 33;  // odd: H.264 wants even sides
    const ShowOutput output = show();
    if (output.movie.empty()) GTEST_SKIP() << output.note;
    EXPECT_EQ(output.movie, m_folder / "pictures" / "time-lapse.mp4");
    EXPECT_GT(fs::file_size(output.movie), 1000U);
    EXPECT_EQ(std::distance(fs::directory_iterator(m_folder / "pictures"), {}), 2);  // no temporary file
}

TEST_F(PictureShow, OptionsThatCannotBeAreInputErrorsAndWriteNothing) {
    const auto refused = [&](auto change) {
        ShowOptions options = m_options;
        change(options);
        EXPECT_THROW(show_take(take::TakeReader(m_folder), options, {}), InputError);
    };
    refused([](auto& o) { o.size = 0; });
    refused([](auto& o) { o.size = 1 << 20; });
    refused([](auto& o) { o.samples = 0; });
    refused([](auto& o) { o.frame = 9; });
    refused([](auto& o) { o.frame = -2; });
    refused([](auto& o) { o.sheet_frames = 0; });
    refused([](auto& o) { o.turntable_views = 0; });
    refused([](auto& o) { o.elevation_deg = 90; });
    refused([](auto& o) { o.azimuth_deg = std::nan(""); });
    refused([](auto& o) { o.frames_per_second = 0; });
    EXPECT_FALSE(fs::exists(m_folder / "pictures"));
    EXPECT_THROW(show_kind_named("hologram"), InputError);
    EXPECT_EQ(show_kind_named("turntable"), ShowKind::Turntable);
}

TEST_F(PictureShow, CancelEndsIt) {
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    EXPECT_THROW(show_take(take::TakeReader(m_folder), m_options, context), Cancelled);
    EXPECT_FALSE(fs::exists(m_folder / "pictures" / "contact-sheet.png"));
}

}  // namespace
}  // namespace windfall::picture
