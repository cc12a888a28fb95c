#pragma once
// What is measured of a drying take; docs/measures.md defines every number.
#include <nlohmann/json.hpp>

#include "take/take_reader.h"

namespace windfall::drying {

/// {"frames": [{"frame", "shrinkage", "depth_rms_over_te", ...}, ...], "onset_shrinkage", "unknowns", ...}
nlohmann::json measure(const take::TakeReader& take);

}  // namespace windfall::drying
