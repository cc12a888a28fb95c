#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/break_buffers.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

// With the shift of split nodes (kSplitShift) below a quarter of a cell in all, no corner can turn inside
// out.
constexpr float kJitter = 0.10F;

// Cells that are much wider than high are bent as their arcs are: there angles move by no more than this
// share of the rings' distance.
constexpr float kMostJitter = 0.3F;

}  // namespace

void lay_out_lattice(const FractureParameters& parameters, PolarLattice& lattice) {
    const int rings = lattice.rings = static_cast<int>(parameters.branch.rings);
    const int sectors = lattice.sectors = static_cast<int>(parameters.branch.sectors);
    const std::uint32_t seed = noise_seed(parameters.seed);
    const float ring_width = 1.0F / static_cast<float>(rings);
    const float sector_width = 2 * std::numbers::pi_v<float> / static_cast<float>(sectors);

    lattice.sector_angle.resize(static_cast<std::size_t>(sectors) + 1);
    std::vector<float> cosine(static_cast<std::size_t>(sectors)), sine(cosine.size());
    for (int s = 0; s <= sectors; ++s)
        lattice.sector_angle[static_cast<std::size_t>(s)] = static_cast<float>(s) * sector_width;
    for (std::size_t s = 0; s < cosine.size(); ++s) {
        cosine[s] = std::cos(lattice.sector_angle[s]);
        sine[s] = std::sin(lattice.sector_angle[s]);
    }

    lattice.node_x.resize(lattice.cell(rings + 1, 0));
    lattice.node_y.resize(lattice.node_x.size());
    lattice.rim_angle.resize(static_cast<std::size_t>(sectors));
    for (int r = 0; r <= rings; ++r) {
        const auto ring = static_cast<std::uint32_t>(r);
        const float inner = r > 0 && r < rings ? 2 * kJitter * ring_width : 0.0F;
        const float radius = static_cast<float>(r) * ring_width;
        const float angle_jitter =
            2 * std::min(kJitter * sector_width, kMostJitter * ring_width / std::max(radius, ring_width));
        float* x = lattice.node_x.data() + lattice.cell(r, 0);
        float* y = lattice.node_y.data() + lattice.cell(r, 0);
        for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(sectors); ++s) {
            const std::uint32_t bits = noise_key(seed, NoisePurpose::NodeRadius, ring, s);
            const float rho = radius + inner * (static_cast<float>(bits >> 16U) * 0x1p-16F - 0.5F);
            const float turn = angle_jitter * (static_cast<float>(bits & 0xffffU) * 0x1p-16F - 0.5F);
            // cos and sin of the small turn, to fourth order
            const float c = 1 - turn * turn * (0.5F - turn * turn * (1.0F / 24));
            const float n = turn * (1 - turn * turn * (1.0F / 6));
            x[s] = rho * (cosine[s] * c - sine[s] * n);
            y[s] = rho * (sine[s] * c + cosine[s] * n);
        }
    }
    const float angle_jitter = 2 * std::min(kJitter * sector_width, kMostJitter * ring_width);
    for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(sectors); ++s) {
        const std::uint32_t bits =
            noise_key(seed, NoisePurpose::NodeRadius, static_cast<std::uint32_t>(rings), s);
        lattice.rim_angle[s] =
            lattice.sector_angle[s] + angle_jitter * (static_cast<float>(bits & 0xffffU) * 0x1p-16F - 0.5F);
    }
}

}  // namespace windfall::fracture
