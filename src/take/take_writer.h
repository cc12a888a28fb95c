#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "take/folder_lock.h"
#include "take/frame_sink.h"
#include "take/take_folder.h"
#include "take/take_info.h"
#include "take/take_status.h"

namespace windfall::take {

/// Writes a take folder, each file whole or not at all. Holds the folder's lock while it lives, so that no
/// other program writes the same take. Used from one thread. Failures while writing (a full disk) are
/// RunErrors.
class TakeWriter : public FrameSink {
  public:
    /// Begins a take in a folder that is not there or empty. An existing take is an InputError that names
    /// --resume and
    /// --force, unless `replace_existing`, which removes that take's own files and leaves all others in the
    /// folder. A folder that holds anything else than a take is an InputError in both cases.
    static TakeWriter create(const std::filesystem::path& folder, const TakeInfo& info,
                             bool replace_existing);

    /// Goes on with the take in `folder`, which must have the same process, seed and parameters (else
    /// InputError with the first key that differs and both values); title, look and recipe become those of
    /// `info`. A take without a checkpoint loses the little it has and begins anew.
    static TakeWriter resume(const std::filesystem::path& folder, const TakeInfo& info);

    void add_mesh(const TakeMesh& mesh) override;
    void add_frame(const Frame& frame) override;
    void save_checkpoint(std::span<const std::byte> bytes) override;
    void set_summary(const nlohmann::json& summary) override;

    /// How the run ended; `reason` is for people (the message of the error).
    void set_status(TakeStatus status, const std::string& reason = "");

    /// Appends a line to log.txt. Never throws: a log that cannot be written must not end a run.
    void log(const std::string& line) noexcept;

    /// The checkpoint that a resumed run goes on from; empty in a fresh take.
    std::optional<std::vector<std::byte>> checkpoint() const;

    const std::filesystem::path& folder() const { return m_folder; }

  private:
    TakeWriter(const std::filesystem::path& folder, TakeHeader header, std::unique_ptr<FolderLock> lock);

    std::filesystem::path m_folder;
    TakeHeader m_header;
    std::map<std::string, std::size_t> m_vertex_counts;  ///< by mesh name
    std::unique_ptr<FolderLock> m_lock;
};

}  // namespace windfall::take
