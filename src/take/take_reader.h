#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "take/frame.h"
#include "take/take_info.h"
#include "take/take_status.h"

namespace windfall::take {

/// Reads a take folder, also one that is still being written: it sees the frames that were there when it was
/// made. Reads meshes at once and all else on demand; const functions may be called from several threads.
/// Whatever is wrong in the folder is an InputError with the file's name.
class TakeReader {
  public:
    explicit TakeReader(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return m_folder; }
    const TakeInfo& info() const { return m_info; }
    TakeStatus status() const { return m_status; }
    const std::string& status_reason() const { return m_reason; }  ///< why it failed; else mostly empty
    const std::vector<TakeMesh>& meshes() const { return m_meshes; }

    /// Frames are numbered 0 .. frame_count() - 1.
    int frame_count() const { return m_frame_count; }
    /// InputError when there is no such frame.
    Frame frame(int index) const;
    /// The same, but the values of its maps are not read, which takes most of the time; their descriptions
    /// are there.
    Frame frame_without_map_values(int index) const;

    /// An empty object before the run has written one.
    nlohmann::json summary() const;

    bool has_checkpoint() const;
    std::vector<std::byte> checkpoint() const;

  private:
    std::filesystem::path m_folder;
    TakeInfo m_info;
    TakeStatus m_status = TakeStatus::Running;
    std::string m_reason;
    std::vector<TakeMesh> m_meshes;
    int m_frame_count = 0;
};

}  // namespace windfall::take
