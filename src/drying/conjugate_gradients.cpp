#include "drying/conjugate_gradients.h"

#include <cmath>
#include <utility>

namespace windfall::drying {

namespace {

constexpr std::size_t kVectorBlock = std::size_t{1} << 14U;

/// Sum over a block with eight running sums, which vectorises without changing with the optimiser's mood.
template <class Term>
double block_sum(std::size_t begin, std::size_t end, Term term) {
    constexpr std::size_t kLanes = 8;
    double sums[kLanes] = {};
    std::size_t i = begin;
    for (; i + kLanes <= end; i += kLanes)
        for (std::size_t k = 0; k < kLanes; ++k) sums[k] += term(i + k);
    for (; i < end; ++i) sums[0] += term(i);
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

double dot(const AlignedArray<float>& a, const AlignedArray<float>& b) {
    return parallel_sum(a.size(), kVectorBlock, [&](std::size_t begin, std::size_t end) {
        const float* pa = a.data();
        const float* pb = b.data();
        return block_sum(begin, end, [=](std::size_t i) { return static_cast<double>(pa[i]) * pb[i]; });
    });
}

template <class Body>
void for_blocks(std::size_t size, const Body& body) {
    parallel_blocks(size, kVectorBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

}  // namespace

ConjugateGradients::ConjugateGradients(Multigrid& multigrid, const AlignedArray<float>& mass,
                                       AddedProduct added)
    : m_multigrid(multigrid),
      m_mass(mass),
      m_added(std::move(added)),
      m_residual(multigrid.vector_size()),
      m_last_residual(multigrid.vector_size()),
      m_preconditioned(multigrid.vector_size()),
      m_direction(multigrid.vector_size()),
      m_product(multigrid.vector_size()) {}

double ConjugateGradients::mass_dot(const AlignedArray<float>& a, const AlignedArray<float>& b) const {
    const auto layers = static_cast<std::size_t>(m_multigrid.layers());
    return parallel_sum(m_mass.size() / layers, kVectorBlock / 64, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t column = begin; column < end; ++column) {
            const float* mass = m_mass.data() + column * layers;
            for (std::size_t i = 0; i < 3; ++i) {
                const float* pa = a.data() + (3 * column + i) * layers;
                const float* pb = b.data() + (3 * column + i) * layers;
                sum += block_sum(0, layers,
                                 [=](std::size_t k) { return static_cast<double>(mass[k]) * pa[k] * pb[k]; });
            }
        }
        return sum;
    });
}

LinearResult ConjugateGradients::solve(const AlignedArray<float>& b, AlignedArray<float>& x, double tolerance,
                                       int max_iterations, double radius, const RunContext& context) {
    const std::size_t size = b.size();
    const double norm_b = std::sqrt(dot(b, b));
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
    float* last_r = m_last_residual.data();
    float* px = x.data();
    for_blocks(size, [&](std::size_t i) { r[i] = b[i]; });
    double rz = 0;
    while (result.iterations < max_iterations) {
        context.throw_if_cancelled();
        m_multigrid.apply(r, z);
        const double new_rz = dot(m_residual, m_preconditioned);
        if (!(new_rz > 0)) {
            result.status = result.iterations == 0 ? LinearStatus::NotDefinite : LinearStatus::IterationLimit;
            return result;
        }
        // Polak-Ribiere: the half-precision smoother is not exactly symmetric, and Fletcher-Reeves would not
        // know.
        double beta = 0;
        if (result.iterations > 0)
            beta = std::max(0.0, (new_rz - dot(m_last_residual, m_preconditioned)) / rz);
        rz = new_rz;
        const auto beta_f = static_cast<float>(beta);
        if (result.iterations == 0)
            for_blocks(size, [&](std::size_t i) { p[i] = z[i]; });
        else
            for_blocks(size, [&](std::size_t i) { p[i] = z[i] + beta_f * p[i]; });
        m_multigrid.product(p, q);
        if (m_added) m_added(p, q);
        const double curvature = dot(m_direction, m_product);
        ++result.iterations;
        const bool negative = !(curvature > 0);
        const double alpha = negative ? 0 : rz / curvature;
        if (std::isfinite(radius)) {
            const double xx = mass_dot(x, x);
            const double xp = mass_dot(x, m_direction);
            const double pp = mass_dot(m_direction, m_direction);
            if (negative || xx + 2 * alpha * xp + alpha * alpha * pp > radius * radius) {
                const double room = std::max(0.0, radius * radius - xx);
                const auto tau = static_cast<float>((-xp + std::sqrt(xp * xp + pp * room)) / pp);
                for_blocks(size, [&](std::size_t i) { px[i] += tau * p[i]; });
                result.status = negative ? LinearStatus::NegativeCurvature : LinearStatus::OnBoundary;
                return result;
            }
        } else if (negative) {
            result.status = LinearStatus::NegativeCurvature;
            return result;
        }
        const auto alpha_f = static_cast<float>(alpha);
        for_blocks(size, [&](std::size_t i) {
            last_r[i] = r[i];
            px[i] += alpha_f * p[i];
            r[i] -= alpha_f * q[i];
        });
        result.relative_residual = std::sqrt(dot(m_residual, m_residual)) / norm_b;
        if (result.relative_residual < tolerance) return result;
    }
    result.status = LinearStatus::IterationLimit;
    return result;
}

}  // namespace windfall::drying
