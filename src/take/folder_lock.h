#pragma once
#include <filesystem>

namespace windfall::take {

/// Keeps other programs from writing the same take while it lives. The system lets go of it when the program
/// ends, however it ends.
class FolderLock {
  public:
    /// InputError when another program holds it or when the folder cannot be written.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    static constexpr const char* kFileName = ".lock";

  private:
    int m_descriptor;
};

}  // namespace windfall::take
