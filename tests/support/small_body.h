#pragma once
// Small solid meshes and random states for the tests of the solver.
#include "core/random.h"
#include "drying/elasticity.h"
#include "geometry/layered_mesh.h"

namespace windfall::test {

/// A sphere of radius 1 with a stone of radius `stone`, n x n x n bricks, `layers` layers of which two are
/// skin.
inline geometry::LayeredMesh small_sphere(int n, int layers, double skin_thickness = 0.1,
                                          double stone = 0.4) {
    return geometry::make_layered_mesh(geometry::SphereShape(1, stone), skin_thickness, {n, n, n},
                                       geometry::graded_layers(layers - 2, 2, 1.2));
}

/// A displacement of every node by at most `amplitude` in each direction, without any pattern.
inline AlignedArray<double> random_displacement(std::size_t size, double amplitude, std::uint64_t seed) {
    AlignedArray<double> result(size);
    for (std::size_t i = 0; i < size; ++i)
        result[i] = amplitude * (2 * random_uniform4(seed, RandomPurpose::LanczosStart, i)[0] - 1);
    return result;
}

/// A symmetric drying tensor that differs from element to element and is not isotropic.
inline Eigen::Matrix3d uneven_drying(std::size_t quad, int layer) {
    const double s = 0.05 * static_cast<double>((quad * 7 + static_cast<std::size_t>(layer) * 3) % 5);
    Eigen::Matrix3d drying;
    drying << 0.9 - s, 0.02, 0.01, 0.02, 0.95 - 0.5 * s, -0.03, 0.01, -0.03, 0.85;
    return drying;
}

}  // namespace windfall::test
