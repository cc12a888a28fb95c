#pragma once
// One hexahedron, plainly: the twin that the SIMD kernels are tested against, and what masses, moisture and
// plastic set need of it. 8 nodes (0..3 below, 4..7
// above, counter-clockwise from outside), 2 x 2 x 2 integration points, mean dilatation.
#include <Eigen/Core>
#include <array>

#include "geometry/layered_mesh.h"

namespace windfall::drying {

using HexNodes = std::array<Eigen::Vector3d, 8>;

/// Nodes of the element of `quad` in `layer`.
HexNodes element_nodes(const geometry::LayeredMesh& mesh, std::size_t quad, int layer);

double hexahedron_volume(const HexNodes& nodes);

/// Deformation gradient dx/dX, mean over the rest volume.
Eigen::Matrix3d mean_deformation(const HexNodes& rest, const HexNodes& now);

struct HexMaterial {
    double shear = 1;
    double bulk = 1;
    Eigen::Matrix3d drying = Eigen::Matrix3d::Identity();  ///< Fd
    Eigen::Vector3d fibre = Eigen::Vector3d::UnitX();      ///< fresh direction over the length without stress
    double fibre_modulus = 0;
};

/// Energy and its derivatives: gradient[3 a + i], hessian(3 a + i, 3 b + j).
struct HexResponse {
    double energy = 0;
    Eigen::Matrix<double, 24, 1> gradient;
    Eigen::Matrix<double, 24, 24> hessian;
};
HexResponse hexahedron_response(const HexNodes& rest, const HexNodes& now, const HexMaterial& material);

/// Volumes and stress of an element.
struct HexState {
    double rest_volume = 0;
    double volume = 0;
    double drying_volume_ratio = 1;   ///< det Fd
    double elastic_volume_ratio = 1;  ///< mean of det Fe: volume / (rest_volume det Fd)
    double smallest_elastic = 1;      ///< min of det Fe over the integration points
    double largest_elastic = 1;
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< Cauchy stress, mean over the current volume
    double pressure = 0;  ///< -kappa (Jbar - 1): positive where squeezed, in units of C0 of the flesh
};
HexState hexahedron_state(const HexNodes& rest, const HexNodes& now, const HexMaterial& material);

}  // namespace windfall::drying
