#pragma once
#include <atomic>

namespace windfall::cli {

/// Turns SIGINT (Ctrl-C) and SIGTERM into a flag that a RunContext watches. A second signal of the same kind
/// ends the program at once.
const std::atomic<bool>& cancel_on_signals();

}  // namespace windfall::cli
