#pragma once
#include "fracture/break_ends.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// Closes both ends: bark from the broken edge along branch.length (branch.piece_length), and a flat cut at
/// the far end. Rows of the bark lie closer together near the break.
void add_bark_walls(const FractureParameters& parameters, BreakEnds& ends);

}  // namespace windfall::fracture
