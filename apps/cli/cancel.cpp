#include "cancel.h"

#include <csignal>

namespace windfall::cli {
namespace {

std::atomic<bool> cancel_requested = false;
// A signal handler may touch nothing that could wait for a lock.
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void request_cancel(int) { cancel_requested.store(true, std::memory_order_relaxed); }

}  // namespace

const std::atomic<bool>& cancel_on_signals() {
    struct sigaction action = {};
    action.sa_handler = request_cancel;
    // SA_RESETHAND: the second signal finds the default action, which kills. SA_RESTART: files being written
    // go on.
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return cancel_requested;
}

}  // namespace windfall::cli
