#pragma once
// The drying part Fd of the deformation gradient for the parameters of a recipe.
#include "drying/elasticity.h"
#include "drying/parameters.h"

namespace windfall::drying {

/// The directions of the fruit at every quad of the brick: columns radial, meridional, latitudinal, unit.
std::vector<Eigen::Matrix3d> fruit_directions(const geometry::LayeredMesh& mesh);

/// Fd of every element at a shrinkage: stretches 1 - factor * shrinkage along the radial, meridional and
/// latitudinal directions of the element; in the skin the factors are multiplied by skin_fraction.
class RecipeDrying {
  public:
    RecipeDrying(const geometry::LayeredMesh& mesh, const ShrinkageParameters& parameters);
    DryingField at(double shrinkage) const;
    /// Fd of one element at a shrinkage of its own.
    Eigen::Matrix3d element(std::size_t quad, int layer, double shrinkage) const;
    /// The shrinkage at which flesh has `volume_ratio` (> 0, <= 1) of its fresh volume: det Fd.
    double shrinkage_for(double volume_ratio) const;

  private:
    ShrinkageParameters m_parameters;
    int m_flesh_layers;
    std::vector<Eigen::Matrix3d> m_directions;  ///< per quad, see fruit_directions
};

}  // namespace windfall::drying
