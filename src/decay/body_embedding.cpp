#include "decay/body_embedding.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace windfall::decay {

namespace {

float smooth_step(double s) { return static_cast<float>(s * s * (3 - 2 * s)); }

}  // namespace

BodyEmbedding::BodyEmbedding(const geometry::BrickSurface& coarse,
                             const std::vector<geometry::Vec3>& coarse_positions,
                             const geometry::BrickSurface& fine,
                             const std::vector<geometry::Vec3>& fine_positions)
    : m_corners(fine.vertex_count()), m_coarse_weight(coarse.vertex_count(), 0.0F) {
    for (std::size_t v = 0; v < m_corners.size(); ++v) {
        const geometry::Lattice& p = fine.lattice[v];
        int axis = 0;
        while (p[axis] != 0 && p[axis] != fine.cells[axis]) ++axis;
        geometry::Lattice low{};
        std::array<double, 3> fraction{};
        for (int k = 0; k < 3; ++k) {
            const double at = static_cast<double>(p[k]) * coarse.cells[k] / fine.cells[k];
            low[k] = k == axis ? static_cast<int>(std::lround(at))
                               : std::min(static_cast<int>(at), coarse.cells[k] - 1);
            fraction[k] = at - low[k];
        }
        const int a = (axis + 1) % 3;
        const int b = (axis + 2) % 3;
        Corners& corners = m_corners[v];
        for (int c = 0; c < 4; ++c) {
            geometry::Lattice corner = low;
            corner[a] += c % 2;
            corner[b] += c / 2;
            const float wa = smooth_step(fraction[a]);
            const float wb = smooth_step(fraction[b]);
            corners.vertex[c] = coarse.vertex_at(corner);
            corners.weight[c] = (c % 2 == 1 ? wa : 1 - wa) * (c / 2 == 1 ? wb : 1 - wb);
            corners.offset[c] =
                (fine_positions[v] - coarse_positions[corners.vertex[c]]).template cast<float>();
            m_coarse_weight[corners.vertex[c]] += corners.weight[c];
        }
    }
}

void BodyEmbedding::map(const std::vector<Eigen::Vector4f>& positions,
                        const std::vector<Eigen::Matrix3f>& gradients,
                        std::vector<Eigen::Vector3f>& result) const {
    result.resize(m_corners.size());
    parallel_blocks(m_corners.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Corners& corners = m_corners[v];
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            for (int c = 0; c < 4; ++c) {
                const auto k = corners.vertex[c];
                sum += corners.weight[c] * (positions[k].head<3>() + gradients[k] * corners.offset[c]);
            }
            result[v] = sum;
        }
    });
}

std::vector<float> BodyEmbedding::coarsen(std::span<const float> fine) const {
    std::vector<float> result(m_coarse_weight.size(), 0.0F);
    for (std::size_t v = 0; v < m_corners.size(); ++v)
        for (int c = 0; c < 4; ++c) result[m_corners[v].vertex[c]] += m_corners[v].weight[c] * fine[v];
    // A coarse vertex that no fine one is near keeps no rot: only where the skin is coarser than the flesh.
    for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = m_coarse_weight[k] > 0 ? result[k] / m_coarse_weight[k] : 0;
    return result;
}

}  // namespace windfall::decay
