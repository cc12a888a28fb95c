#pragma once
// What a process is given besides its parameters: where progress goes, when to stop.
#include <atomic>
#include <functional>
#include <string>

#include "core/error.h"

namespace windfall {

/// How far a process is. `done` and `total` are in the process's own unit (drying: shrinkage).
struct Progress {
    std::string stage;  ///< what is being done, for people: "buckling modes", "drying"
    double done = 0;
    double total = 1;
    double seconds_left = -1;  ///< estimate; negative while it is not known
    std::string detail;        ///< one short line: "shrinkage 0.183, depth 1.02 t_e"
};

/// Handle of one run. The caller owns it and keeps it alive while the process runs. `cancel` may be set from
/// another thread or from a signal handler; all else is used from the thread that runs the process.
struct RunContext {
    std::function<void(const Progress&)> on_progress;  ///< may be empty
    std::function<void(const std::string&)> on_log;    ///< a line for the log; may be empty
    const std::atomic<bool>* cancel = nullptr;         ///< null: cannot be cancelled

    bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
    void throw_if_cancelled() const {
        if (cancelled()) throw Cancelled();
    }
    void progress(const Progress& p) const {
        if (on_progress) on_progress(p);
    }
    void log(const std::string& line) const {
        if (on_log) on_log(line);
    }
};

}  // namespace windfall
