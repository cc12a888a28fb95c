#pragma once
// Moves the inner nodes of a mesh of tetrahedra until none of these is inside out and all are as much as can
// be like they were designed.
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

/// A tetrahedron with the positive shape that it is designed for. Elements may overlap: the eight corners of
/// a hexahedron.
struct DesignedElement {
    std::array<std::int32_t, 4> node{};
    Eigen::Matrix3d design = Eigen::Matrix3d::Identity();  ///< columns: edges from node 0 to nodes 1, 2, 3
};

/// Smallest ratio of an element's volume to its design's (both scaled to the same sum), and which it is.
struct WorstElement {
    double ratio = 0;
    std::size_t element = 0;
};

/// Nodes [0, free) move, the rest stays. First the harmonic map (least Dirichlet energy), then descent on the
/// foldover-free energy of Garanzha, Kaporin, Kudryavtseva, Protais, Ray and Sokolov 2021, Foldover-free maps
/// in 50 lines of code, eq. (2)-(4).
WorstElement unfold(std::vector<Vec3>& nodes, std::size_t free, const std::vector<DesignedElement>& elements);

}  // namespace windfall::geometry
