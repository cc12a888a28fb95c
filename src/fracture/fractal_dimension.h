#pragma once
// Box-counting dimension of a broken surface: 2 for a smooth one, towards 3 the rougher it is.
#include <Eigen/Core>
#include <array>
#include <vector>

namespace windfall::fracture {

/// Heights over a square of the cross-section, at (side + 1)^2 nodes, row by row.
struct HeightGrid {
    int side = 0;        ///< intervals along an edge
    double spacing = 0;  ///< between neighbouring nodes, in the unit of the heights
    std::vector<float> heights;

    float at(int column, int row) const {
        return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(side + 1) +
                       static_cast<std::size_t>(column)];
    }
};

using Triangle = std::array<Eigen::Vector3f, 3>;

/// The highest of the triangles' points over each node of the square |x|, |y| <= half_width. A node that no
/// triangle covers takes the height of the nearest one before it in its row, or of the row before.
HeightGrid height_grid(const std::vector<Triangle>& triangles, double half_width, int side);

/// Differential box counting (Sarkar & Chaudhuri 1994, An efficient differential box-counting approach to
/// compute fractal dimension of image) with cubes of 4, 8, ... intervals, the largest an eighth of the
/// square's edge. A column of base r^2 in which the heights span d meets d / r + 1 cubes in the mean over all
/// positions of the lowest one; their number is taken in the mean over all places of the columns as well. d
/// is the span of 5 x 5 heights whatever r, so that large cubes do not see more of what lies between the
/// nodes than small ones. The dimension is the slope of log(number of cubes) over log(1 / r), by least
/// squares. `side` must be at least 64.
double box_counting_dimension(const HeightGrid& grid);

}  // namespace windfall::fracture
