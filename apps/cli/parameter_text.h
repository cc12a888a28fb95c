#pragma once
#include <string>

#include "recipe/process.h"

namespace windfall::cli {

/// Every parameter of the process and of the look, grouped, with unit, range, default and meaning, for a
/// terminal.
std::string parameter_reference(const recipe::Process& process);

}  // namespace windfall::cli
