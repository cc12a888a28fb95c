#pragma once
// How a run tells of itself: a bar on a terminal, lines in a log, JSON for programs (docs/progress.md).
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "take/frame.h"

namespace windfall::cli {

class ProgressPrinter {
  public:
    virtual ~ProgressPrinter() = default;
    virtual void warning(const std::string& text) = 0;
    virtual void progress(const Progress& progress) = 0;
    virtual void frame(const take::Frame& frame) = 0;
    /// The last word of a run that ended well. `pictures` may be empty.
    virtual void done(const std::filesystem::path& take,
                      const std::vector<std::filesystem::path>& pictures) = 0;
    /// The same of a command that wrote files and no take.
    virtual void written(const std::vector<std::filesystem::path>& files) = 0;
    /// The last word of one that did not end well. The text for people goes to stderr in any case.
    virtual void error(const std::string& text, int exit_code) = 0;
};

/// "plain", "bar", "json".
const std::vector<std::string>& progress_kinds();

/// `kind` as above, or empty for a bar where stderr is a terminal and plain lines elsewhere.
std::unique_ptr<ProgressPrinter> make_progress_printer(const std::string& kind);

/// "1:05 left"; empty while the time is not known.
std::string time_left_text(double seconds);

}  // namespace windfall::cli
