#pragma once
// Choices by name.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"

namespace windfall::picture {

/// The enumerator whose number is the place of `name` in `names`; InputError naming `what` and the choices
/// otherwise.
template <class Enum>
Enum choice_named(const std::string& what, const std::vector<std::string>& names, const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
        throw InputError(
            fmt::format("there is no {} \"{}\"; choose one of {}", what, name, fmt::join(names, ", ")));
    return static_cast<Enum>(at - names.begin());
}

}  // namespace windfall::picture
