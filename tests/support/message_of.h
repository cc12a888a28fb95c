#pragma once
#include <string>

#include "core/error.h"

namespace windfall {

/// What the error of type Error says that `action` throws; "no error" when it throws none.
template <class Error = InputError, class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Error& problem) {
        return problem.what();
    }
    return "no error";
}

}  // namespace windfall
