#include "drying/flesh_diffusion.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/parallel.h"

namespace windfall::drying {

namespace {

constexpr std::size_t kColumnBlock = 128;
constexpr std::size_t kCellBlock = 4096;

double product(const std::vector<double>& a, const std::vector<double>& b) {
    return parallel_sum(a.size(), kCellBlock, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
        return sum;
    });
}

double total(const std::vector<double>& a) {
    return parallel_sum(a.size(), kCellBlock, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += a[i];
        return sum;
    });
}

void for_cells(std::size_t count, const std::function<void(std::size_t)>& body) {
    parallel_blocks(count, kCellBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

}  // namespace

QuadEvaporation evaporation(double content, double conductance, double leaving, double arriving,
                            double solutes) {
    // What comes from the cell's centre evaporates: T (m - m_s) = leaving m_s / (m_s + solutes) - arriving,
    // a quadratic equation for the content m_s at the skin with one root that is not negative.
    const double b = conductance * (solutes - content) + leaving - arriving;
    const double c = -solutes * (conductance * content + arriving);
    const double root = std::sqrt(std::max(0.0, b * b - 4 * conductance * c));
    const double at_skin = b > 0 ? -2 * c / (b + root) : (root - b) / (2 * conductance);
    // Not T (m - m_s), which is all rounding where diffusion is fast.
    const double flux = leaving * at_skin / (at_skin + solutes) - arriving;
    if (!(flux > 0)) return {};
    const double steepness = leaving * solutes / ((at_skin + solutes) * (at_skin + solutes));
    return {flux, conductance * steepness / (conductance + steepness)};
}

/// The matrix restricted to each column of cells, factorised: diagonal inverses and what couples upwards.
struct FleshDiffusion::Columns {
    std::vector<double> inverse_pivots, ratios;
    std::size_t layers;

    Columns(const FleshDiffusion& system, double tau, const std::vector<double>& leak)
        : inverse_pivots(system.m_cells.size()),
          ratios(system.m_cells.size()),
          layers(system.m_cells.layers()) {
        const FleshCells& cells = system.m_cells;
        const auto& up = system.m_conductances.up;
        const auto& side = system.m_conductances.side;
        const double d = system.m_diffusivity;
        parallel_blocks(cells.quads(), kColumnBlock, [&](std::size_t begin, std::size_t end) {
            for (std::size_t q = begin; q < end; ++q)
                for (std::size_t k = 0; k < layers; ++k) {
                    const std::size_t i = q * layers + k;
                    double diagonal = cells.volumes()[i] / tau + (k + 1 < layers ? d * up[i] : leak[q]);
                    for (const std::int32_t e : cells.edges(q)) diagonal += d * side[e * layers + k];
                    if (k > 0) {
                        const double coupling = d * up[i - 1];
                        ratios[i] = coupling * inverse_pivots[i - 1];
                        diagonal += coupling - coupling * ratios[i];
                    }
                    inverse_pivots[i] = 1 / diagonal;
                }
        });
    }

    void solve(const std::vector<double>& right, std::vector<double>& x) const {
        parallel_blocks(right.size() / layers, kColumnBlock, [&](std::size_t begin, std::size_t end) {
            for (std::size_t q = begin; q < end; ++q) {
                const std::size_t first = q * layers;
                x[first] = right[first];
                for (std::size_t i = first + 1; i < first + layers; ++i)
                    x[i] = right[i] + ratios[i] * x[i - 1];
                for (std::size_t i = first + layers; i-- > first;) {
                    x[i] *= inverse_pivots[i];
                    if (i + 1 < first + layers) x[i] += ratios[i + 1] * x[i + 1];
                }
            }
        });
    }
};

FleshDiffusion::FleshDiffusion(const FleshCells& cells, const FleshConductances& conductances,
                               double diffusivity)
    : m_cells(cells), m_conductances(conductances), m_diffusivity(diffusivity) {}

/// y = (V / tau + D L + leak) x. Each cell gathers; a face's flux has the same bits on both its sides.
void FleshDiffusion::apply(const std::vector<double>& x, double tau, const std::vector<double>& leak,
                           std::vector<double>& y) const {
    const std::size_t layers = m_cells.layers();
    const auto& up = m_conductances.up;
    const auto& side = m_conductances.side;
    parallel_blocks(m_cells.quads(), kColumnBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q) {
            const auto& neighbours = m_cells.neighbours(q);
            const auto& edges = m_cells.edges(q);
            for (std::size_t k = 0; k < layers; ++k) {
                const std::size_t i = q * layers + k;
                double outflow = 0;
                for (std::size_t c = 0; c < 4; ++c)
                    outflow += side[edges[c] * layers + k] * (x[i] - x[neighbours[c] * layers + k]);
                if (k > 0) outflow += up[i - 1] * (x[i] - x[i - 1]);
                if (k + 1 < layers) outflow += up[i] * (x[i] - x[i + 1]);
                y[i] = m_cells.volumes()[i] / tau * x[i] + m_diffusivity * outflow;
                if (k + 1 == layers) y[i] += leak[q] * x[i];
            }
        }
    });
}

/// Conjugate gradients with the columns as preconditioner, then a shift of all contents by one number, which
/// makes the water's balance exact.
void FleshDiffusion::solve(const std::vector<double>& right, double tau, const std::vector<double>& leak,
                           std::vector<double>& x) const {
    constexpr double kContentError = 1e-9;  // of the contents, in the root mean square
    constexpr double kRounding = 1e-15;
    constexpr int kMostIterations = 3000;
    const std::size_t size = m_cells.size();
    const Columns columns(*this, tau, leak);
    const double weight = m_cells.volume() / tau + total(leak);
    std::vector<double> residual = right, z(size), direction(size), image(size);
    std::fill(x.begin(), x.end(), 0);
    double allowed = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const double error =
            kContentError * m_cells.volumes()[i] / tau + kRounding / columns.inverse_pivots[i];
        allowed += error * error;
    }
    const auto shift = [&] {
        const double by = total(residual) / weight;
        for_cells(size, [&](std::size_t i) { x[i] += by; });
        apply(x, tau, leak, image);
        for_cells(size, [&](std::size_t i) { residual[i] = right[i] - image[i]; });
    };
    shift();
    double rz = 0;
    for (int iteration = 0; iteration < kMostIterations && product(residual, residual) > allowed;
         ++iteration) {
        columns.solve(residual, z);
        const double new_rz = product(residual, z);
        const double beta = iteration == 0 ? 0 : new_rz / rz;
        rz = new_rz;
        for_cells(size, [&](std::size_t i) { direction[i] = z[i] + beta * direction[i]; });
        apply(direction, tau, leak, image);
        const double alpha = rz / product(direction, image);
        for_cells(size, [&](std::size_t i) {
            x[i] += alpha * direction[i];
            residual[i] -= alpha * image[i];
        });
    }
    shift();
}

double FleshDiffusion::stage(const std::vector<double>& from, double tau, const SkinEvaporation& skin,
                             std::vector<double>& contents) const {
    constexpr int kMostNewton = 20;
    constexpr double kConverged = 1e-7;  // the error left is of the size of its square
    const std::size_t size = m_cells.size();
    const std::size_t layers = m_cells.layers();
    const std::vector<double> none(m_cells.quads(), 0);
    std::vector<double> leak(m_cells.quads()), flux(m_cells.quads()), right(size), change(size);
    double evaporated = 0;
    for (int newton = 0; newton < kMostNewton; ++newton) {
        // V (m - from) / tau + D L m + evaporation = 0
        apply(contents, tau, none, right);
        for (std::size_t i = 0; i < size; ++i) right[i] = m_cells.volumes()[i] / tau * from[i] - right[i];
        for (std::size_t q = 0; q < m_cells.quads(); ++q) {
            const std::size_t top = q * layers + layers - 1;
            const QuadEvaporation at =
                evaporation(std::max(0.0, contents[top]), m_diffusivity * m_conductances.up[top],
                            skin.leaving[q], skin.arriving[q], skin.solutes);
            flux[q] = at.flux;
            leak[q] = at.slope;
            right[top] -= flux[q];
        }
        solve(right, tau, leak, change);
        evaporated = 0;
        double largest = 0;
        for (std::size_t q = 0; q < m_cells.quads(); ++q) {
            const std::size_t top = q * layers + layers - 1;
            evaporated += flux[q] + leak[q] * change[top];
            largest = std::max(largest, std::abs(change[top]));
        }
        for (std::size_t i = 0; i < size; ++i) contents[i] += change[i];
        if (largest < kConverged) break;
    }
    return evaporated;
}

double FleshDiffusion::step(std::vector<double>& contents, double dt, const SkinEvaporation& first,
                            const SkinEvaporation& last) const {
    const std::vector<double> start = contents;
    const double first_rate = stage(start, kFirstStage * dt, first, contents);
    // start + (1 - gamma) dt f(first stage), with dt f from what the first stage moved
    std::vector<double> from(start.size());
    constexpr double kShare = (1 - kFirstStage) / kFirstStage;
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = start[i] + kShare * (contents[i] - start[i]);
    const double last_rate = stage(from, kFirstStage * dt, last, contents);
    return dt * ((1 - kFirstStage) * first_rate + kFirstStage * last_rate);
}

}  // namespace windfall::drying
