#pragma once
// The three ways in which a command ends early; apps/cli turns them into exit codes.
#include <stdexcept>

namespace windfall {

/// The user asked for something that cannot be: a bad value, a misspelt key, a file that is not there.
/// The text says what, where (file:line:column when there is one) and what to do. Exit code 2.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The input was sound and the work failed all the same: lost equilibrium, a full disk. Exit code 1.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The user cancelled (Ctrl-C); whatever was complete is on disk. Exit code 130.
class Cancelled : public std::runtime_error {
  public:
    Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace windfall
