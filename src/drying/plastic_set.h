#pragma once
// Plastic set: what stays of a deformation when its cause is gone. F = Fe Fp Fd with det Fp = 1; the law
// being isotropic, only Cp = Fp^T Fp matters, one for each element.
//
// Flow is perfectly plastic: where the equivalent elastic strain sqrt(2/3 e : e), e being the deviator of the
// logarithmic strain of Fe, passes the yield strain, Fp takes the excess, along the principal directions of
// Fe (the exponential return mapping of Weber and Anand 1990; Simo 1992). At a given deformation that only
// lowers the elastic energy: the difference is dissipated.
#include <Eigen/Core>
#include <vector>

#include "drying/elasticity.h"

namespace windfall::drying {

/// The symmetric stretch U of the stress-free state, U^2 = Fd Cp Fd. `drying`: Fd, symmetric.
Eigen::Matrix3d stress_free_stretch(const Eigen::Matrix3d& drying, const Eigen::Matrix3d& set);

/// Cp after flow at the deformation gradient F; `set` itself where it does not flow.
Eigen::Matrix3d set_after_flow(const Eigen::Matrix3d& deformation, const Eigen::Matrix3d& drying,
                               const Eigen::Matrix3d& set, double yield_strain);

/// sqrt(2/3 e : e) of an elastic deformation gradient.
double equivalent_elastic_strain(const Eigen::Matrix3d& elastic);

/// Cp of all elements: [quad * layers + layer][6] as xx, xy, xz, yy, yz, zz; empty: I everywhere.
using PlasticSet = std::vector<double>;

/// The stress-free stretch of every element. Keeps a reference to `set`.
DryingField with_set(DryingField drying, const PlasticSet& set, int layers);

/// Yield strains; 0: never.
struct YieldStrains {
    double flesh = 0;
    double skin = 0;
    bool any() const { return flesh > 0 || skin > 0; }
};

/// Lets every element flow at its mean deformation gradient. `nodes`: positions now, as LayeredMesh::nodes.
void flow(PlasticSet& set, const geometry::LayeredMesh& mesh, const std::vector<geometry::Vec3>& nodes,
          const DryingField& drying, const YieldStrains& yield);

}  // namespace windfall::drying
