#pragma once
// The flesh as finite volumes: every element of it a cell that holds water.
//
// Content m: volume of water in a cell over the cell's fresh volume. By Fick's law, for a body that shrinks,
// the water moves against the gradient of water per solids, relative to the solids (Crank 1975,
// section 10.6). Pulled back to the fresh body that is  dm/dt = Div(D C^-1 Grad m), C = F^T F:  volumes and
// faces stay the fresh ones and F enters the conductances alone, so that no water is made or lost however the
// body moves.
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// Conductances over a diffusivity of 1, in lengths of the mesh: flux of content through a face over the
/// difference of the contents on its two sides.
struct FleshConductances {
    std::vector<double> up;  ///< [quad * layers + k]: from cell k to k + 1; the last: to the flesh's surface
    std::vector<double> side;  ///< [edge * layers + k]: between the cells on both sides of an edge
};

class FleshCells {
  public:
    /// The innermost `flesh_layers` of a mesh; what lies beyond and the stone let no water through by
    /// themselves.
    explicit FleshCells(const geometry::LayeredMesh& mesh);

    /// For the body with these nodes (as in LayeredMesh).
    FleshConductances conductances(const std::vector<geometry::Vec3>& nodes) const;
    /// Area of each quad of the outer surface, for the body with these nodes.
    std::vector<double> skin_areas(const std::vector<geometry::Vec3>& nodes) const;

    std::size_t quads() const { return m_neighbours.size(); }
    std::size_t layers() const { return static_cast<std::size_t>(m_mesh.flesh_layers); }
    std::size_t size() const { return quads() * layers(); }
    /// Fresh volumes: [quad * layers + k], k = 0 at the stone.
    const std::vector<double>& volumes() const { return m_volumes; }
    double volume() const { return m_volume; }
    /// The quads beyond the four edges of a quad, and those edges.
    const std::array<std::int32_t, 4>& neighbours(std::size_t quad) const { return m_neighbours[quad]; }
    const std::array<std::int32_t, 4>& edges(std::size_t quad) const { return m_edges[quad]; }

  private:
    /// Of a cell's six faces (four sides, below, above): area vectors, and area times the distance of their
    /// middle from the cell's. On oblique cells that errs least: the distance along the normal makes
    /// conductances too large, the part of the area across the way too small.
    struct Faces {
        std::array<geometry::Vec3, 6> areas;
        std::array<double, 6> reaches;
    };

    geometry::LayeredMesh m_mesh;
    std::vector<double> m_volumes;
    double m_volume = 0;
    std::vector<Faces> m_faces;
    std::vector<std::array<std::int32_t, 4>> m_neighbours, m_edges;
    std::vector<std::array<std::int32_t, 2>> m_edge_quads;    ///< the quads on both sides of an edge
    std::vector<std::array<std::int32_t, 2>> m_edge_corners;  ///< which edge of those quads it is
};

}  // namespace windfall::drying
