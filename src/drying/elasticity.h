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

/// Fibres in the body: by quad of the brick a direction in the fresh fruit, by layer Young's modulus that
/// they add along it (see fibres.h).
struct Fibres {
    std::vector<Eigen::Vector3d> directions;  ///< unit; empty: no fibres
    std::vector<double> moduli;               ///< in C0 of the flesh
    double shrinkage = 1;                     ///< along themselves, as a fraction of what is around them
    bool empty() const { return directions.empty(); }
    /// The direction over the length free of stress; `drying`: Fd of the element.
    Eigen::Vector3d relaxed(std::size_t quad, const Eigen::Matrix3d& drying) const;
};

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
               const std::vector<double>& flesh_stiffening = {}, Fibres fibres = {});

    /// Sets Fd of every element. Fd = I, the fresh state, at first.
    void set_drying(const DryingField& field) { set_drying(field, field); }
    /// The same with plastic set, of which fibres know nothing: they have their length from the drying alone.
    void set_drying(const DryingField& stress_free, const DryingField& drying_alone);

    /// Energy; with `force` not null sets it to the energy's gradient.
    ElasticEnergy energy(const AlignedArray<double>& displacement, AlignedArray<double>* force) const;

    /// Volumes of the elements: [quad][kVolumeEntries][layers], quads in the multigrid's order.
    AlignedArray<double> volumes(const AlignedArray<double>& displacement) const;

    /// Sets the multigrid's matrix to the energy's second derivatives; `geometric` 1: exactly, less: stress
    /// terms scaled down. Then adds `mass_factor` times the mass matrix.
    void assemble(const AlignedArray<double>& displacement, double geometric, double mass_factor);

    /// Lumped mass matrix for unit density: [column][layers].
    const AlignedArray<double>& mass() const { return m_mass; }
    /// The same over its sum, in single precision: weights of a mean square.
    const AlignedArray<float>& mean_weights() const { return m_mean_weights; }
    std::size_t size() const { return m_multigrid.vector_size(); }
    Multigrid& multigrid() { return m_multigrid; }
    const Multigrid& multigrid() const { return m_multigrid; }

  private:
    ElementArrays arrays() const;
    FibreArrays fibre_arrays() const { return {m_relaxed_fibres.data()}; }
    void set_fibres(const DryingField& field);

    Multigrid& m_multigrid;
    std::int64_t m_moduli_stride = 0;
    AlignedArray<double> m_rest, m_base, m_shear, m_bulk, m_dehydration, m_mass;
    AlignedArray<float> m_mean_weights;
    Fibres m_fibres;
    AlignedArray<double> m_relaxed_fibres;  ///< as FibreArrays; empty without fibres
};

}  // namespace windfall::drying
