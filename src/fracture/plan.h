#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fracture/parameters.h"

namespace windfall::fracture {

/// What `run` will make, for people and for warnings before it is made.
struct Plan {
    std::int64_t vertices = 0;  ///< of both ends, about
    std::int64_t frames = 1;
    std::optional<double> law_height;   ///< mean height by the height law of the wood, radii; none for a log
    std::vector<std::string> warnings;  ///< each with the number to set
};
Plan plan(const FractureParameters& parameters);

}  // namespace windfall::fracture
