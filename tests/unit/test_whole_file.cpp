#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "take/whole_file.h"

namespace windfall::take {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
  protected:
    std::size_t entry_count() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_folder.path()), {}));
    }
    TemporaryFolder m_folder;
    fs::path m_path = m_folder.path() / "a.txt";
};

// No file of this process may grow beyond `bytes` while it lives.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : m_handler(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &m_before);
        rlimit limit = m_before;
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &m_before);
        std::signal(SIGXFSZ, m_handler);
    }

  private:
    void (*m_handler)(int);
    rlimit m_before{};
};

TEST_F(WholeFile, WritesAndReplaces) {
    write_whole_file(m_path, "first");
    EXPECT_EQ(read_whole_text(m_path, 100), "first");
    write_whole_file(m_path, "second, longer");
    EXPECT_EQ(read_whole_text(m_path, 100), "second, longer");
    EXPECT_EQ(entry_count(), 1u);
}

TEST_F(WholeFile, FailureLeavesTheOldFileAndNoTemporary) {
    write_whole_file(m_path, "first");
    std::string message;
    {
        const FileSizeLimit limit(1000);
        message = message_of<RunError>(
            [&] { write_whole_file(m_path, std::string(5000, 'x'), "run again with --resume"); });
    }
    EXPECT_THAT(message,
                testing::AllOf(testing::HasSubstr(m_path.string()), testing::HasSubstr(std::strerror(EFBIG)),
                               testing::EndsWith("and run again with --resume")));
    EXPECT_EQ(read_whole_text(m_path, 100), "first");
    EXPECT_EQ(entry_count(), 1u);
}

TEST_F(WholeFile, AFullDiskIsTold) {
    const int full = ::open("/dev/full", O_WRONLY);
    if (full < 0) GTEST_SKIP() << "no /dev/full here";
    EXPECT_EQ(write_all(full, std::as_bytes(std::span("text"))), ENOSPC);
    ::close(full);
}

TEST_F(WholeFile, AMissingFolderIsTold) {
    EXPECT_THAT(message_of<RunError>([&] { write_whole_file(m_folder.path() / "no" / "a.txt", "x"); }),
                testing::AllOf(testing::HasSubstr("no/a.txt"), testing::HasSubstr(std::strerror(ENOENT))));
}

TEST_F(WholeFile, AFolderInTheWayIsTold) {
    fs::create_directories(m_path / "inside");
    EXPECT_THROW(write_whole_file(m_path, "x"), RunError);
    EXPECT_EQ(entry_count(), 1u);
}

TEST_F(WholeFile, ReadingRefusesWhatIsNoSoundFile) {
    EXPECT_THAT(
        message_of<InputError>([&] { read_whole_file(m_path, 100); }),
        testing::AllOf(testing::HasSubstr(m_path.string()), testing::HasSubstr(std::strerror(ENOENT))));
    EXPECT_THROW(read_whole_file(m_folder.path(), 100), InputError);
    write_whole_file(m_path, "12345");
    EXPECT_THAT(message_of<InputError>([&] { read_whole_file(m_path, 4); }), testing::HasSubstr("5 bytes"));
    const fs::path pipe = m_folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(message_of<InputError>([&] { read_whole_file(pipe, 100); }), testing::HasSubstr("regular"));
}

TEST_F(WholeFile, FoldersAreMadeOrRefused) {
    const fs::path deep = m_folder.path() / "a" / "b";
    make_writable_folder(deep);
    EXPECT_TRUE(fs::is_directory(deep));
    EXPECT_TRUE(fs::is_empty(deep));
    write_whole_file(m_path, "x");
    EXPECT_THAT(message_of<InputError>([&] { make_writable_folder(m_path); }),
                testing::HasSubstr("is a file"));
    EXPECT_THAT(message_of<InputError>([&] { make_writable_folder(m_path / "below"); }),
                testing::AllOf(testing::HasSubstr("cannot make the folder"), testing::HasSubstr("-o")));
    EXPECT_THAT(message_of<InputError>([&] { make_writable_folder("/proc/self"); }),
                testing::HasSubstr("cannot write into the folder"));
}

}  // namespace
}  // namespace windfall::take
