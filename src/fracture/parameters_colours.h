#pragma once
#include "fracture/parameters.h"

namespace windfall::fracture {

/// Adds the keys colours.* to the table of fracture.
void add_colours(ParameterTable<FractureParameters>& table);

/// Throws InputError for a colour that has neither three numbers nor none.
void check_colours(const FractureParameters& parameters);

}  // namespace windfall::fracture
