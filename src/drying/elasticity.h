#pragma once
// The elastic body in solver order: energy, out-of-balance force and tangent of all elements, from several
// threads.
#include <Eigen/Core>
#include <functional>
#include <limits>

#include "core/aligned_array.h"
#include "drying/multigrid.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// Shear and bulk moduli, layer by layer, in units of C0 of the flesh (whose shear modulus is mu = 2 C0 = 2).
struct LayerModuli {
    std::vector<double> shear, bulk;
};
LayerModuli layer_moduli(int flesh_layers, int layers, double gamma, double bulk_ratio);

/// The drying part Fd of an element's deformation gradient, by quad of the brick and layer; symmetric.
using DryingField = std::function<Eigen::Matrix3d(std::size_t quad, int layer)>;

struct ElasticEnergy {
    double energy = 0;
    double smallest_volume_ratio = 0;  ///< min of det F over the integration points
    /// False where an element is inverted or the numbers ran over; energy means nothing then.
    bool valid() const { return smallest_volume_ratio > 0 && energy < std::numeric_limits<double>::max(); }
};

/// Displacements and forces are [column][3][layers] in the multigrid's order. The stone does not move.
class Elasticity {
  public:
    /// Keeps a reference to `multigrid`, whose finest matrix it assembles into, and copies all else.
    /// `flesh_stiffening`: by quad of the brick, factors of the moduli of its flesh; empty: 1 everywhere.
    Elasticity(const geometry::LayeredMesh& mesh, const LayerModuli& moduli, Multigrid& multigrid,
               const std::vector<double>& flesh_stiffening = {});

    /// Sets Fd of every element. Fd = I, the fresh state, at first.
    void set_drying(const DryingField& field);

    /// Energy; with `force` not null sets it to the energy's gradient.
    ElasticEnergy energy(const AlignedArray<double>& displacement, AlignedArray<double>* force) const;

    /// Sets the multigrid's matrix to the energy's second derivatives; `geometric` 1: exactly, less: stress
    /// terms scaled down. Then adds `mass_factor` times the mass matrix.
    void assemble(const AlignedArray<double>& displacement, double geometric, double mass_factor);

    /// Lumped mass matrix for unit density: [column][layers].
    const AlignedArray<double>& mass() const { return m_mass; }
    /// The same over its sum, in single precision: weights of a mean square.
    const AlignedArray<float>& mean_weights() const { return m_mean_weights; }
    std::size_t size() const { return m_multigrid.vector_size(); }
    Multigrid& multigrid() { return m_multigrid; }

  private:
    ElementArrays arrays() const;

    Multigrid& m_multigrid;
    std::int64_t m_moduli_stride = 0;
    AlignedArray<double> m_rest, m_base, m_shear, m_bulk, m_dehydration, m_mass;
    AlignedArray<float> m_mean_weights;
};

}  // namespace windfall::drying
