#pragma once
// The part of a body's motion that varies slowly over it: the shrinking of the fruit as a whole, not that of
// wrinkles.
#include "core/aligned_array.h"
#include "drying/column_order.h"
#include "geometry/smooth_surface.h"

namespace windfall::drying {

/// Slow part of the motion between two displacements ([column][3][layers] in the order of the solver), layer
/// by layer its projection onto the slow functions.
AlignedArray<double> slow_motion(const geometry::SlowField& slow, const ColumnOrder& order,
                                 std::size_t layers, const AlignedArray<double>& from,
                                 const AlignedArray<double>& to);

}  // namespace windfall::drying
