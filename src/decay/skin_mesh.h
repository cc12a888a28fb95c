#pragma once
// The skin as springs and bending stencils on the surface of a cube mapped onto the fruit.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/brick_surface.h"

namespace windfall::decay {

/// A neighbour of a vertex: the spring to it and its part in the bending stencils.
struct SkinNeighbour {
    std::int32_t vertex = 0;
    float spring = 0;  ///< stiffness over the membrane stiffness E t
    float weight = 0;  ///< of the neighbour in this vertex's mean; a vertex's weights add to 1
};

/// Vertices are counted in the order of their colours, so that those which a loop may change at the same time
/// lie side by side; `vertex_of` leads back to the brick's order.
struct SkinMesh {
    std::vector<std::int32_t> vertex_of;
    std::vector<std::int32_t> colour_begin;  ///< colours + 1
    std::vector<std::int32_t> begin;         ///< vertices + 1: places in `neighbours`
    std::vector<SkinNeighbour> neighbours;   ///< the four (three at a corner) sides, and the diagonals
    std::vector<float> weight_back;  ///< per neighbour: the weight of this vertex in the neighbour's mean
    std::vector<std::array<std::int32_t, 4>> quads;
    std::vector<float> area_m2;
    std::vector<float> bending;  ///< stiffness of |d - mean d|^2 / 2 over the bending modulus, 1/m^2
    double mean_edge_m = 0;      ///< of the sides

    std::size_t size() const { return vertex_of.size(); }
};

/// Springs: on a square grid of cells a, sides 3/4 and diagonals 3/8 of E t make an isotropic sheet of
/// modulus E t and Poisson's ratio 1/3; elsewhere each quad gives its area over the spring's length squared.
/// Bending: B/2 (laplacian d)^2 with the laplacian (mean d - d) 4 / (mean square distance), sides weighing
/// four times the diagonals, which makes its error isotropic. No two vertices of a colour are neighbours or
/// have a neighbour in common.
SkinMesh make_skin_mesh(const geometry::BrickSurface& brick, const std::vector<geometry::Vec3>& positions);

}  // namespace windfall::decay
