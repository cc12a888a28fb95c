#include "drying/conjugate_gradients.h"

#include <cmath>
#include <utility>

#include "drying/vector_loops.h"

namespace windfall::drying {

ConjugateGradients::ConjugateGradients(Multigrid& multigrid, const AlignedArray<float>& mass,
                                       AddedProduct added)
    : m_multigrid(multigrid),
      m_mass(mass),
      m_added(std::move(added)),
      m_residual(multigrid.vector_size()),
      m_preconditioned(multigrid.vector_size()),
      m_direction(multigrid.vector_size()),
      m_product(multigrid.vector_size()) {}

template <class Update>
ConjugateGradients::Lengths ConjugateGradients::updated_lengths(const float* x, const float* p,
                                                                const Update& update) const {
    constexpr std::size_t kLanes = 8;
    constexpr std::size_t kMassBlock = 256;  // columns
    const auto layers = static_cast<std::size_t>(m_multigrid.layers());
    const std::size_t columns = m_mass.size() / layers;
    std::vector<Lengths> partial((columns + kMassBlock - 1) / kMassBlock);
    parallel_blocks(columns, kMassBlock, [&](std::size_t begin, std::size_t end) {
        double sums[3][kLanes] = {};
        for (std::size_t at = begin * 3 * layers; at < end * 3 * layers; at += kLanes) {
            const float* mass = m_mass.data() + at / (3 * layers) * layers + at % layers;
            for (std::size_t k = 0; k < kLanes; ++k) update(at + k);
            for (std::size_t k = 0; k < kLanes; ++k) {
                const double weighted_x = static_cast<double>(mass[k]) * x[at + k];
                const double weighted_p = static_cast<double>(mass[k]) * p[at + k];
                sums[0][k] += weighted_x * x[at + k];
                sums[1][k] += weighted_x * p[at + k];
                sums[2][k] += weighted_p * p[at + k];
            }
        }
        Lengths& block = partial[begin / kMassBlock];
        for (std::size_t k = 0; k < kLanes; ++k) {
            block.xx += sums[0][k];
            block.xp += sums[1][k];
            block.pp += sums[2][k];
        }
    });
    Lengths result;
    for (const Lengths& block : partial) {
        result.xx += block.xx;
        result.xp += block.xp;
        result.pp += block.pp;
    }
    return result;
}

double ConjugateGradients::length(const AlignedArray<float>& x) const {
    return std::sqrt(updated_lengths(x.data(), x.data(), [](std::size_t) {}).xx);
}

LinearResult ConjugateGradients::solve(const AlignedArray<float>& b, AlignedArray<float>& x, double tolerance,
                                       int max_iterations, double radius, const RunContext& context) {
    const std::size_t size = b.size();
    const double norm_b = std::sqrt(dot(b.data(), b.data(), size));
    LinearResult result;
    x.set_zero();
    if (norm_b == 0) {
        result.relative_residual = 0;
        return result;
    }
    float* r = m_residual.data();
    float* z = m_preconditioned.data();
    float* p = m_direction.data();
    float* q = m_product.data();
    float* px = x.data();
    const float* right = b.data();
    for_elements(size, [=](std::size_t i) { r[i] = right[i]; });
    m_direction.set_zero();

    // The step along the last direction is put off until the vectors are gone through for the next one.
    double step = 0;
    const auto finish = [&](LinearStatus status) {
        const auto last = static_cast<float>(step);
        if (last != 0) for_elements(size, [=](std::size_t i) { px[i] += last * p[i]; });
        result.status = status;
        return result;
    };
    double curvature = 0;
    while (result.iterations < max_iterations) {
        context.throw_if_cancelled();
        m_multigrid.apply(r, z);
        const auto [rz, qz] = dots(r, q, z, size);
        if (!(rz > 0))
            return finish(result.iterations == 0 ? LinearStatus::NotDefinite : LinearStatus::IterationLimit);
        // Conjugate to the last direction, whatever the preconditioner: the half-precision smoother is not
        // exactly symmetric, and the usual quotient of two rz would not know.
        const auto beta = result.iterations == 0 ? 0.0F : static_cast<float>(std::max(0.0, -qz / curvature));
        const auto [xx, xp, pp] = updated_lengths(px, p, [=, last = static_cast<float>(step)](std::size_t i) {
            px[i] += last * p[i];
            p[i] = z[i] + beta * p[i];
        });
        curvature = m_multigrid.product(p, q);
        if (m_added) curvature += m_added(p, q);
        ++result.iterations;
        const bool negative = !(curvature > 0);
        step = negative ? 0 : rz / curvature;
        if (std::isfinite(radius)) {
            if (negative || xx + 2 * step * xp + step * step * pp > radius * radius) {
                const double room = std::max(0.0, radius * radius - xx);
                step = (-xp + std::sqrt(xp * xp + pp * room)) / pp;
                return finish(negative ? LinearStatus::NegativeCurvature : LinearStatus::OnBoundary);
            }
        } else if (negative) {
            return finish(LinearStatus::NegativeCurvature);
        }
        result.relative_residual = std::sqrt(subtract(static_cast<float>(step), q, r, size)) / norm_b;
        if (result.relative_residual < tolerance) return finish(LinearStatus::Converged);
    }
    return finish(LinearStatus::IterationLimit);
}

}  // namespace windfall::drying
