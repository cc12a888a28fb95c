#include "take/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace windfall::take {

// The lock is on a file of its own and not on the folder, since NFS locks only what is open for writing. The
// file stays: removing it would let a third program lock a new file while a second one waits for the old.
FolderLock::FolderLock(const std::filesystem::path& folder)
    : m_descriptor(::open((folder / kFileName).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (m_descriptor < 0)
        throw InputError(fmt::format("cannot write into the folder {}: {}; choose another one with -o",
                                     folder.string(), std::strerror(errno)));
    // Any other errno: a file system without locks, where a take can be written all the same.
    if (::flock(m_descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(m_descriptor);
        throw InputError(
            fmt::format("another program is writing the take {}; wait for its end, or choose another "
                        "folder with -o",
                        folder.string()));
    }
}

FolderLock::~FolderLock() { ::close(m_descriptor); }

}  // namespace windfall::take
