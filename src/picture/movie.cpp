#include "picture/movie.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"

namespace windfall::picture {
namespace {

constexpr int kPollMilliseconds = 100;
constexpr std::size_t kMostWords = 4000;  // of what ffmpeg says, its end

/// A program at work, its words (stdout and stderr) in a pipe.
class Child {
  public:
    /// `error()` tells the errno when it could not be started.
    explicit Child(std::vector<std::string> arguments) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) {
            m_error = errno;
            return;
        }
        m_words = ends[0];
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        m_error = posix_spawnp(&m_pid, pointers[0], &actions, nullptr, pointers.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        if (m_error != 0) m_pid = -1;
    }
    ~Child() {
        if (m_pid > 0) {
            kill(m_pid, SIGKILL);
            wait();
        }
        if (m_words >= 0) close(m_words);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    int error() const { return m_error; }

    /// All it says until it ends; throws Cancelled (and the destructor ends the program).
    std::string listen(const RunContext& context) {
        std::string words;
        for (;;) {
            context.throw_if_cancelled();
            pollfd ready{m_words, POLLIN, 0};
            const int count = poll(&ready, 1, kPollMilliseconds);
            if (count < 0 && errno != EINTR) return words;
            if (count <= 0) continue;
            char buffer[4096];
            const ssize_t got = read(m_words, buffer, sizeof(buffer));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return words;
            words.append(buffer, static_cast<std::size_t>(got));
            if (words.size() > kMostWords) words.erase(0, words.size() - kMostWords);
        }
    }
    /// Its exit status; -1 when it was killed.
    int wait() {
        int status = 0;
        while (waitpid(m_pid, &status, 0) < 0)
            if (errno != EINTR) return -1;
        m_pid = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t m_pid = -1;
    int m_words = -1;
    int m_error = 0;
};

/// Removes a file when it goes out of scope.
struct Removed {
    std::filesystem::path path;
    explicit Removed(std::filesystem::path file) : path(std::move(file)) {}
    Removed(const Removed&) = delete;
    Removed& operator=(const Removed&) = delete;
    ~Removed() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

}  // namespace

bool make_movie(const std::string& ffmpeg, const std::filesystem::path& folder, int count,
                double frames_per_second, const std::filesystem::path& movie, const RunContext& context) {
    const Removed part{movie.parent_path() / fmt::format(".{}.part.mp4", movie.stem().string())};
    // A percent sign in a folder's name would be read as part of the pattern; doubled, it is a percent sign.
    std::string pattern;
    for (const char c : folder.string()) pattern.append(c == '%' ? 2 : 1, c);
    pattern = fmt::format("file:{}/%04d.png", pattern);
    Child child({ffmpeg,
                 "-nostdin",
                 "-hide_banner",
                 "-loglevel",
                 "error",
                 "-y",
                 "-framerate",
                 fmt::format("{}", frames_per_second),
                 "-start_number",
                 "0",
                 "-i",
                 pattern,
                 "-frames:v",
                 fmt::format("{}", count),
                 "-vf",
                 "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                 "-c:v",
                 "libx264",
                 "-crf",
                 "18",
                 "-pix_fmt",
                 "yuv420p",
                 "-movflags",
                 "+faststart",
                 fmt::format("file:{}", part.path.string())});
    if (child.error() == ENOENT || child.error() == EACCES) return false;
    if (child.error() != 0)
        throw RunError(fmt::format("cannot start {}: {}", ffmpeg, std::strerror(child.error())));
    const std::string words = child.listen(context);
    const int status = child.wait();
    if (status != 0)
        throw RunError(fmt::format("{} could not make {}: {}", ffmpeg, movie.string(),
                                   words.empty() ? fmt::format("it ended with status {}", status) : words));
    std::error_code error;
    std::filesystem::rename(part.path, movie, error);
    if (error) throw RunError(fmt::format("cannot write {}: {}", movie.string(), error.message()));
    return true;
}

}  // namespace windfall::picture
