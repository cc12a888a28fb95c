#pragma once
// Finds the spherical triangle around a direction: cells on the six sides of a cube, where great circles are
// straight lines, each with a list of the triangles that may reach into it.
#include <cstdint>
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// Owns copies of what it is built from. Immutable; safe to read from several threads.
class SphereGrid {
  public:
    /// `directions`: unit, per vertex; the triangles cover the sphere once.
    SphereGrid(const std::vector<Vec3>& directions, const std::vector<Triangle>& triangles);

    /// The triangle around a direction (any length but zero) and the weights whose weighted mean of its
    /// corners' directions points there.
    SurfacePlace place(const Vec3& direction) const;

  private:
    struct Cell {
        int side = 0, column = 0, row = 0;
    };
    Cell cell_of(const Vec3& direction) const;
    std::size_t index_of(const Cell& cell) const {
        return (static_cast<std::size_t>(cell.side) * m_size + cell.row) * m_size + cell.column;
    }

    int m_size = 0;  ///< cells along an edge of the cube
    std::vector<std::uint32_t> m_starts;
    std::vector<std::int32_t> m_triangles;
    std::vector<std::array<Vec3, 3>> m_corners;  ///< per triangle
};

}  // namespace windfall::geometry
