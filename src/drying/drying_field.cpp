#include "drying/drying_field.h"

#include <Eigen/Geometry>
#include <cmath>

namespace windfall::drying {

std::vector<Eigen::Matrix3d> fruit_directions(const geometry::LayeredMesh& mesh) {
    std::vector<Eigen::Matrix3d> result;
    const Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
    for (const auto& quad : mesh.brick.quads) {
        Eigen::Vector3d radial = Eigen::Vector3d::Zero();
        for (const std::int32_t vertex : quad) radial += mesh.outward[vertex];
        radial.normalize();
        // At the poles all directions across the axis are alike.
        Eigen::Vector3d latitudinal = axis.cross(radial);
        if (latitudinal.norm() < 1e-9) latitudinal = Eigen::Vector3d::UnitX();
        latitudinal.normalize();
        Eigen::Matrix3d frame;
        frame << radial, latitudinal.cross(radial), latitudinal;
        result.push_back(frame);
    }
    return result;
}

RecipeDrying::RecipeDrying(const geometry::LayeredMesh& mesh, const ShrinkageParameters& parameters)
    : m_parameters(parameters), m_flesh_layers(mesh.flesh_layers), m_directions(fruit_directions(mesh)) {}

Eigen::Matrix3d RecipeDrying::element(std::size_t quad, int layer, double shrinkage) const {
    const double own = layer < m_flesh_layers ? shrinkage : shrinkage * m_parameters.skin_fraction;
    const Eigen::Vector3d stretches(1 - own * m_parameters.radial, 1 - own * m_parameters.meridional,
                                    1 - own * m_parameters.latitudinal);
    // Exactly a multiple of the identity where it should be: rounding in the frames must not leak in.
    if (stretches.x() == stretches.y() && stretches.y() == stretches.z())
        return stretches.x() * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d& frame = m_directions[quad];
    return frame * stretches.asDiagonal() * frame.transpose();
}

double RecipeDrying::shrinkage_for(double volume_ratio) const {
    const double a = m_parameters.radial;
    const double b = m_parameters.meridional;
    const double c = m_parameters.latitudinal;
    if (a == b && b == c) return (1 - std::cbrt(volume_ratio)) / a;
    // The product of the stretches falls and is convex: from below Newton's method never oversteps.
    constexpr int kMostIterations = 50;
    constexpr double kEnough = 1e-14;
    double shrinkage = 0;
    for (int i = 0; i < kMostIterations; ++i) {
        const double x = 1 - a * shrinkage;
        const double y = 1 - b * shrinkage;
        const double z = 1 - c * shrinkage;
        const double step = (x * y * z - volume_ratio) / (a * y * z + b * x * z + c * x * y);
        shrinkage += step;
        if (step < kEnough) break;
    }
    return shrinkage;
}

DryingField RecipeDrying::at(double shrinkage) const {
    return [this, shrinkage](std::size_t quad, int layer) { return element(quad, layer, shrinkage); };
}

}  // namespace windfall::drying
