#include "take/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <future>
#include <memory>
#include <system_error>

#include "core/error.h"

namespace windfall::take {
namespace {

constexpr std::string_view kTemporaryPrefix = ".windfall-", kTemporarySuffix = ".tmp";

// Short whatever the name of the file, so that a long name cannot make an impossible one.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
    static std::atomic<unsigned> counter{0};
    return path.parent_path() /
           fmt::format("{}{}-{}{}", kTemporaryPrefix, getpid(), counter++, kTemporarySuffix);
}

std::string remedy(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "free some space";
        case EFBIG:
            return "raise the limit on the size of files (ulimit -f)";
        case EACCES:
        case EPERM:
        case EROFS:
            return "make the folder writable";
        case ENOENT:
        case ENOTDIR:
            return "put the folder back";
        default:
            return "see to the disk";
    }
}

// A file that is being written; unless it was renamed, its temporary goes with the object.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& path)
        : m_path(path),
          m_descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)),
          m_open_error(m_descriptor < 0 ? errno : 0) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        const bool created = m_descriptor >= 0 || m_closed;
        if (m_descriptor >= 0) ::close(m_descriptor);
        if (created && !m_renamed) ::unlink(m_path.c_str());
    }

    bool is_open() const { return m_descriptor >= 0; }

    // All return 0 or the errno.
    int write(std::span<const std::byte> bytes) {
        if (m_open_error != 0) return m_open_error;
        const int error = write_all(m_descriptor, bytes);
        return error != 0 ? error : sync_and_close();
    }
    int sync_and_close() {
        // EINVAL: a file system without fsync, where there is nothing to wait for.
        const int error = ::fsync(m_descriptor) != 0 && errno != EINVAL ? errno : 0;
        const bool closed = ::close(m_descriptor) == 0;
        m_descriptor = -1;
        m_closed = true;
        if (error != 0) return error;
        return closed ? 0 : errno;
    }
    int rename_to(const std::filesystem::path& target) {
        if (std::rename(m_path.c_str(), target.c_str()) != 0) return errno;
        m_renamed = true;
        return 0;
    }

  private:
    std::filesystem::path m_path;
    int m_descriptor;
    int m_open_error;
    bool m_closed = false, m_renamed = false;
};

[[noreturn]] void cannot_write(const std::filesystem::path& path, int error, std::string_view how_to_go_on) {
    throw RunError(fmt::format("cannot write {}: {}; {} and {}", path.string(), std::strerror(error),
                               remedy(error), how_to_go_on));
}

[[noreturn]] void cannot_read(const std::filesystem::path& path, int error) {
    throw InputError(fmt::format("cannot read {}: {}", path.string(), std::strerror(error)));
}

}  // namespace

int write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) continue;
            return errno;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                      std::string_view how_to_go_on) {
    TemporaryFile file(temporary_beside(path));
    int error = file.write(bytes);
    if (error == 0) error = file.rename_to(path);
    if (error != 0) cannot_write(path, error, how_to_go_on);
}

void write_whole_files(const std::vector<WholeFile>& files, std::string_view how_to_go_on) {
    std::vector<std::unique_ptr<TemporaryFile>> temporaries(files.size());
    std::vector<std::future<int>> errors;
    for (std::size_t i = 0; i < files.size(); ++i)
        // A thread for each, since all they do is wait for the disk.
        errors.push_back(std::async(std::launch::async, [&, i] {
            temporaries[i] = std::make_unique<TemporaryFile>(temporary_beside(files[i].path));
            return temporaries[i]->write(files[i].bytes);
        }));
    for (const auto& error : errors) error.wait();
    for (std::size_t i = 0; i < files.size(); ++i)
        if (const int error = errors[i].get(); error != 0) cannot_write(files[i].path, error, how_to_go_on);
    for (std::size_t i = 0; i < files.size(); ++i)
        if (const int error = temporaries[i]->rename_to(files[i].path); error != 0)
            cannot_write(files[i].path, error, how_to_go_on);
}

void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      std::string_view how_to_go_on) {
    write_whole_file(path, std::as_bytes(std::span(text)), how_to_go_on);
}

bool is_temporary_name(const std::string& file_name) {
    return file_name.starts_with(kTemporaryPrefix) && file_name.ends_with(kTemporarySuffix);
}

std::vector<std::byte> read_whole_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    // O_NONBLOCK: opening a named pipe must not wait for its writer.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) cannot_read(path, errno);
    const struct Closer {
        explicit Closer(int opened) : descriptor(opened) {}
        Closer(const Closer&) = delete;
        Closer& operator=(const Closer&) = delete;
        ~Closer() { ::close(descriptor); }
        int descriptor;
    } closer(descriptor);

    struct stat status {};
    if (::fstat(descriptor, &status) != 0) cannot_read(path, errno);
    if (!S_ISREG(status.st_mode))
        throw InputError(fmt::format("cannot read {}: not a regular file", path.string()));
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > max_bytes)
        throw InputError(fmt::format("cannot read {}: it has {} bytes, and no such file has more than {}",
                                     path.string(), size, max_bytes));
    std::vector<std::byte> bytes(size);
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(descriptor, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) cannot_read(path, errno);
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return bytes;
}

std::string read_whole_text(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const auto bytes = read_whole_file(path, max_bytes);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void make_writable_folder(const std::filesystem::path& folder) {
    std::error_code problem;
    if (std::filesystem::exists(folder, problem) && !std::filesystem::is_directory(folder, problem))
        throw InputError(
            fmt::format("{} is a file, not a folder; choose another name with -o", folder.string()));
    std::filesystem::create_directories(folder, problem);
    if (problem)
        throw InputError(fmt::format("cannot make the folder {}: {}; choose another one with -o",
                                     folder.string(), problem.message()));
    if (const TemporaryFile probe(temporary_beside(folder / "x")); !probe.is_open())
        throw InputError(fmt::format("cannot write into the folder {}: {}; choose another one with -o",
                                     folder.string(), std::strerror(errno)));
}

}  // namespace windfall::take
