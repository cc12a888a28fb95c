#pragma once
#include <nlohmann/json.hpp>

#include "take/take_reader.h"

namespace windfall::decay {

/// The table of `windfall measure` for a take of decay: docs/measures.md. Throws InputError for frames that
/// lack their numbers.
nlohmann::json measure(const take::TakeReader& take);

}  // namespace windfall::decay
