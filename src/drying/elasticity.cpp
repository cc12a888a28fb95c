#include "drying/elasticity.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "drying/element.h"

namespace windfall::drying {

namespace {
constexpr std::size_t kBlock = 256;
}  // namespace

LayerModuli layer_moduli(int flesh_layers, int layers, double gamma, double bulk_ratio) {
    constexpr double kFleshShear = 2;  // mu = 2 C0, C0 of the flesh is the unit of stress
    LayerModuli moduli;
    for (int k = 0; k < layers; ++k) {
        moduli.shear.push_back(kFleshShear * (k < flesh_layers ? 1 : gamma));
        moduli.bulk.push_back(bulk_ratio * moduli.shear.back());
    }
    return moduli;
}

Elasticity::Elasticity(const geometry::LayeredMesh& mesh, const LayerModuli& moduli, Multigrid& multigrid,
                       const std::vector<double>& flesh_stiffening, Fibres fibres)
    : m_multigrid(multigrid),
      m_moduli_stride(flesh_stiffening.empty() ? 0 : mesh.layers),
      m_rest(multigrid.vector_size()),
      m_base(mesh.columns() * 3),
      m_shear(moduli.shear.size() * std::max<std::size_t>(1, flesh_stiffening.size())),
      m_bulk(m_shear.size()),
      m_dehydration(mesh.brick.quads.size() * 7 * mesh.layers),
      m_mass(mesh.columns() * mesh.layers),
      m_mean_weights(mesh.columns() * mesh.layers),
      m_fibres(std::move(fibres)),
      m_relaxed_fibres(m_fibres.directions.size() * kFibreEntries * mesh.layers) {
    const ColumnOrder& order = multigrid.order();
    const auto layers = static_cast<std::size_t>(mesh.layers);
    for (std::size_t i = 0; i < m_shear.size(); ++i) {
        const std::size_t layer = i % layers;
        const bool stiffened =
            !flesh_stiffening.empty() && layer < static_cast<std::size_t>(mesh.flesh_layers);
        const double factor =
            stiffened ? flesh_stiffening[static_cast<std::size_t>(order.brick_quad[i / layers])] : 1;
        m_shear[i] = factor * moduli.shear[layer];
        m_bulk[i] = factor * moduli.bulk[layer];
    }
    for (std::size_t c = 0; c < mesh.columns(); ++c) {
        const std::int32_t vertex = order.vertex_of_solver[c];
        for (std::size_t i = 0; i < 3; ++i) {
            m_base[3 * c + i] = mesh.base[vertex][static_cast<int>(i)];
            for (std::size_t k = 0; k < layers; ++k)
                m_rest[(3 * c + i) * layers + k] = mesh.nodes[vertex * layers + k][static_cast<int>(i)];
        }
    }
    std::vector<double> shares(mesh.brick.quads.size() * layers);
    parallel_blocks(mesh.brick.quads.size(), kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q)
            for (std::size_t k = 0; k < layers; ++k)
                shares[q * layers + k] = hexahedron_volume(element_nodes(mesh, q, static_cast<int>(k))) / 8;
    });
    double total = 0;
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q) {
        for (std::size_t k = 0; k < layers; ++k) {
            const double share = shares[q * layers + k];
            for (const std::int32_t vertex : mesh.brick.quads[q]) {
                double* mass = m_mass.data() + order.solver_of_vertex[vertex] * layers;
                mass[k] += share;
                if (k > 0) mass[k - 1] += share;
                total += share * (k > 0 ? 2 : 1);
            }
        }
    }
    for (std::size_t i = 0; i < m_mass.size(); ++i) m_mean_weights[i] = static_cast<float>(m_mass[i] / total);
    set_drying([](std::size_t, int) { return Eigen::Matrix3d(Eigen::Matrix3d::Identity()); });
}

void Elasticity::set_drying(const DryingField& stress_free, const DryingField& drying_alone) {
    const ColumnOrder& order = m_multigrid.order();
    const auto layers = static_cast<std::size_t>(m_multigrid.layers());
    parallel_blocks(order.quads.size(), kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q) {
            double* out = m_dehydration.data() + q * 7 * layers;
            for (std::size_t k = 0; k < layers; ++k) {
                const Eigen::Matrix3d drying = stress_free(order.brick_quad[q], static_cast<int>(k));
                const Eigen::Matrix3d inverse = drying.inverse();
                const Eigen::Matrix3d inv_cd = inverse * inverse.transpose();
                const double values[7] = {drying.determinant(), inv_cd(0, 0), inv_cd(0, 1), inv_cd(0, 2),
                                          inv_cd(1, 1),         inv_cd(1, 2), inv_cd(2, 2)};
                for (std::size_t i = 0; i < 7; ++i) out[i * layers + k] = values[i];
            }
        }
    });
    if (!m_fibres.empty()) set_fibres(drying_alone);
}

Eigen::Vector3d Fibres::relaxed(std::size_t quad, const Eigen::Matrix3d& drying) const {
    const Eigen::Vector3d& direction = directions[quad];
    return direction / (direction + shrinkage * (drying * direction - direction)).norm();
}

void Elasticity::set_fibres(const DryingField& field) {
    const ColumnOrder& order = m_multigrid.order();
    const auto layers = static_cast<std::size_t>(m_multigrid.layers());
    parallel_blocks(order.quads.size(), kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q) {
            const auto quad = static_cast<std::size_t>(order.brick_quad[q]);
            double* out = m_relaxed_fibres.data() + q * kFibreEntries * layers;
            for (std::size_t k = 0; k < layers; ++k) {
                const auto layer = static_cast<int>(k);
                const Eigen::Matrix3d drying = field(quad, layer);
                const Eigen::Vector3d relaxed = m_fibres.relaxed(quad, drying);
                for (std::size_t i = 0; i < 3; ++i) out[i * layers + k] = relaxed[static_cast<int>(i)];
                out[3 * layers + k] = m_fibres.moduli[k] * drying.determinant();
            }
        }
    });
}

ElementArrays Elasticity::arrays() const {
    return {reinterpret_cast<const std::int32_t(*)[4]>(m_multigrid.order().quads.data()),
            m_rest.data(),
            m_base.data(),
            m_shear.data(),
            m_bulk.data(),
            m_dehydration.data(),
            m_moduli_stride};
}

ElasticEnergy Elasticity::energy(const AlignedArray<double>& displacement,
                                 AlignedArray<double>* force) const {
    const ElementArrays elements = arrays();
    double* out = nullptr;
    if (force != nullptr) {
        force->set_zero();
        out = force->data();
    }
    ElasticEnergy result;
    result.smallest_volume_ratio = std::numeric_limits<double>::infinity();
    std::vector<EnergySums> sums;
    for (const auto& ranges : m_multigrid.order().quad_ranges) {
        sums.resize(ranges.size());
        for_ranges(ranges, [&](std::size_t i) {
            sums[i] = m_multigrid.table().energy(elements, displacement.data(), out, ranges[i]);
            if (!m_fibres.empty())
                sums[i].energy += m_multigrid.table().fibre_energy(elements, fibre_arrays(),
                                                                   displacement.data(), out, ranges[i]);
        });
        for (const EnergySums& sum : sums) {
            result.energy += sum.energy;
            result.smallest_volume_ratio = std::min(result.smallest_volume_ratio, sum.smallest_volume_ratio);
        }
    }
    return result;
}

AlignedArray<double> Elasticity::volumes(const AlignedArray<double>& displacement) const {
    const std::size_t quads = m_multigrid.order().quads.size();
    AlignedArray<double> result(quads * kVolumeEntries * m_multigrid.layers());
    const ElementArrays elements = arrays();
    parallel_blocks(quads, kBlock, [&](std::size_t begin, std::size_t end) {
        m_multigrid.table().volumes(elements, displacement.data(), result.data(),
                                    {static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end)});
    });
    return result;
}

void Elasticity::assemble(const AlignedArray<double>& displacement, double geometric, double mass_factor) {
    const ElementArrays elements = arrays();
    m_multigrid.set_matrix_zero();
    const MatrixArrays matrix = m_multigrid.matrix();
    const ColumnOrder& order = m_multigrid.order();
    const auto* pair_entry = reinterpret_cast<const std::int32_t(*)[6]>(order.pair_entry.data());
    for_schedule(order.quad_ranges, [&](Range range) {
        m_multigrid.table().assemble(elements, displacement.data(), pair_entry, {geometric}, matrix, range);
        if (!m_fibres.empty())
            m_multigrid.table().assemble_fibres(elements, fibre_arrays(), displacement.data(), pair_entry,
                                                {geometric}, matrix, range);
    });
    if (mass_factor == 0) return;
    const auto layers = static_cast<std::size_t>(m_multigrid.layers());
    parallel_blocks(m_mass.size() / layers, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < layers; ++k)
                    matrix.diagonal[(c * 18 + 9 + 4 * i) * layers + k] +=
                        static_cast<float>(mass_factor * m_mass[c * layers + k]);
    });
}

}  // namespace windfall::drying
