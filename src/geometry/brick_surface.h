#pragma once
// The surface of a brick of n_x x n_y x n_z cells as a quadrilateral mesh: the topology of every solid mesh
// here. With equal sides it is the cubed sphere; long fruit get a long brick.
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

using Lattice = std::array<int, 3>;
using Quad = std::array<std::int32_t, 4>;

struct BrickSurface {
    Lattice cells{};               ///< n_x, n_y, n_z
    std::vector<Lattice> lattice;  ///< per vertex: its integer coordinates, 0..n in each direction
    std::vector<Quad> quads;       ///< counter-clockwise seen from outside

    std::size_t vertex_count() const { return lattice.size(); }
    /// Index of the vertex at a lattice point of the surface; -1 for a point that is not on it.
    std::int32_t vertex_at(const Lattice& point) const;

    std::vector<std::int32_t>
        side_vertices[6];  ///< per side: (n_b + 1) x (n_a + 1) vertex indices, a fastest
};

/// Throws InputError unless every side has at least one cell.
BrickSurface make_brick_surface(const Lattice& cells);

/// Axes (a, b) that span a side, ordered so that a x b points out of the brick.
std::array<int, 2> side_axes(int side);

/// Texture coordinates per quad corner: the six sides in a 3 x 2 atlas with a margin around each.
std::vector<std::array<Vec2, 4>> brick_atlas(const BrickSurface& brick);

/// The brick with half as many cells each way. Cells must be even.
Lattice coarser(const Lattice& cells);
/// Whether `coarser` may be taken: all sides even and none below 4.
bool can_coarsen(const Lattice& cells);

/// For every vertex of `fine`: the vertices of `coarse` (its brick with half the cells) it is interpolated
/// from bilinearly; each has weight 1 / parents.size().
struct Parents {
    std::array<std::int32_t, 4> vertex{};
    int count = 0;
};
std::vector<Parents> brick_parents(const BrickSurface& fine, const BrickSurface& coarse);

}  // namespace windfall::geometry
