#pragma once
#include <stdexcept>
#include <string>

namespace windfall::cli {

/// A cancelled command, with a text that says what is there and how to go on.
class CancelledRun : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace windfall::cli
