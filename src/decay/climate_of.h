#pragma once
#include "decay/parameters.h"
#include "water/climate.h"

namespace windfall::decay {

/// The air that the parameters ask for. Throws InputError, naming the keys, for a table whose columns differ
/// in length or that water::Climate does not take.
water::Climate climate_of(const ClimateParameters& parameters);

}  // namespace windfall::decay
