#pragma once
// What is measured of a take of a broken branch; docs/measures.md defines every number.
#include <nlohmann/json.hpp>

#include "take/take_reader.h"

namespace windfall::fracture {

/// {"frames": [{"frame", "time", "stub_volume", ...}, ...], "mean_height", "fractal_dimension", ...}. Throws
/// InputError for a take without frames or without the stub's mesh.
nlohmann::json measure(const take::TakeReader& take);

}  // namespace windfall::fracture
