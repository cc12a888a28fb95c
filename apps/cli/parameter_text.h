#pragma once
#include <string>

namespace windfall::cli {

/// Every parameter of drying and of the look, grouped, with unit, range, default and meaning, for a terminal.
std::string parameter_reference();

}  // namespace windfall::cli
