#include "drying/multigrid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "drying/vector_loops.h"

namespace windfall::drying {

namespace {

constexpr std::size_t kBlockColumns = 256;

/// Largest magnitude in [begin, end), with running maxima side by side so that it vectorises.
float largest_magnitude(const float* begin, const float* end) {
    constexpr std::ptrdiff_t kLanes = 32;
    float largest[kLanes] = {};
    for (; end - begin >= kLanes; begin += kLanes)
        for (std::ptrdiff_t k = 0; k < kLanes; ++k) {
            const float magnitude = std::abs(begin[k]);
            largest[k] = magnitude > largest[k] ? magnitude : largest[k];
        }
    for (; begin != end; ++begin) largest[0] = std::max(largest[0], std::abs(*begin));
    return *std::max_element(largest, largest + kLanes);
}

float largest_magnitude(const AlignedArray<float>& values, std::size_t size) {
    constexpr std::size_t kBlock = std::size_t{1} << 18U;
    std::vector<float> partial((size + kBlock - 1) / kBlock);
    parallel_for_each(partial.size(), [&](std::size_t i) {
        partial[i] =
            largest_magnitude(values.data() + i * kBlock, values.data() + std::min(size, (i + 1) * kBlock));
    });
    return partial.empty() ? 0 : *std::max_element(partial.begin(), partial.end());
}

/// A power of two that takes `largest` to at most 8192: far from half precision's 65504, with room for sums.
float half_precision_scale(float largest) {
    if (!(largest > 0) || !std::isfinite(largest)) return 1;
    return std::exp2(std::floor(std::log2(8192.0F / largest)));
}

Range range_of(std::size_t begin, std::size_t end) {
    return {static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end)};
}

}  // namespace

struct Multigrid::Level {
    geometry::BrickSurface brick;
    ColumnOrder order;
    AlignedArray<float> diagonal, lower;
    AlignedArray<std::uint16_t> packed;
    AlignedArray<float> inverse_factor;
    float matrix_scale = 1;
    AlignedArray<float> residual;
    AlignedArray<float> b, x;                      ///< not on the finest level
    AlignedArray<float> defect, corrected, image;  ///< where conjugate gradients solve
    AlignedArray<float> direction;                 ///< on the coarsest level

    // To the next coarser level; empty on the coarsest.
    std::vector<std::int32_t> child_begin, child_column, parent_count;
    std::vector<float> child_weight;
    std::vector<std::array<std::int32_t, 4>> parent;

    Level(geometry::BrickSurface surface, int layers, bool below)
        : brick(std::move(surface)),
          order(make_column_order(brick)),
          diagonal(columns() * 18 * layers),
          lower(order.lower_column.size() * 27 * layers),
          packed((columns() * inverse_vectors(layers) + order.lower_column.size() * 27) * layers),
          inverse_factor(columns()),
          residual(columns() * 3 * layers) {
        if (!below) return;
        for (AlignedArray<float>* array : {&b, &x}) *array = AlignedArray<float>(residual.size());
    }

    void prepare_conjugate_gradients() {
        for (AlignedArray<float>* array : {&defect, &corrected, &image})
            *array = AlignedArray<float>(residual.size());
    }

    std::size_t columns() const { return order.vertex_of_solver.size(); }
    MatrixArrays matrix() {
        return {order.lower_begin.data(), order.lower_column.data(), diagonal.data(), lower.data()};
    }
    UpperArrays upper() const {
        return {order.upper_begin.data(), order.upper_column.data(), order.upper_entry.data()};
    }
    SmootherArrays smoother() { return {packed.data(), matrix_scale, inverse_factor.data()}; }
    TransferArrays transfer() const {
        return {child_begin.data(), child_column.data(), child_weight.data(),
                reinterpret_cast<const std::int32_t(*)[4]>(parent.data()), parent_count.data()};
    }

    void connect(const Level& coarse) {
        const auto parents = geometry::brick_parents(brick, coarse.brick);
        parent.resize(columns());
        parent_count.resize(columns());
        std::vector<std::vector<std::pair<std::int32_t, float>>> children(coarse.columns());
        for (std::size_t v = 0; v < columns(); ++v) {
            const auto& own = parents[order.vertex_of_solver[v]];
            parent_count[v] = own.count;
            for (int p = 0; p < own.count; ++p) {
                parent[v][p] = coarse.order.solver_of_vertex[own.vertex[p]];
                children[parent[v][p]].emplace_back(static_cast<std::int32_t>(v),
                                                    1.0F / static_cast<float>(own.count));
            }
        }
        child_begin.assign(1, 0);
        for (const auto& list : children) {
            for (const auto& [column, weight] : list) {
                child_column.push_back(column);
                child_weight.push_back(weight);
            }
            child_begin.push_back(static_cast<std::int32_t>(child_column.size()));
        }
    }
};

Multigrid::Multigrid(const geometry::BrickSurface& brick, int layers, const KernelTable& table,
                     std::size_t krylov_columns)
    : m_layers(layers), m_table(table) {
    m_levels.push_back(std::make_unique<Level>(brick, layers, false));
    while (geometry::can_coarsen(m_levels.back()->brick.cells)) {
        m_levels.push_back(std::make_unique<Level>(
            geometry::make_brick_surface(geometry::coarser(m_levels.back()->brick.cells)), layers, true));
        m_levels[m_levels.size() - 2]->connect(*m_levels.back());
    }
    if (m_levels.size() < 2) throw std::logic_error("multigrid needs cells that can be halved");
    Level& coarsest = *m_levels.back();
    coarsest.prepare_conjugate_gradients();
    coarsest.direction = AlignedArray<float>(coarsest.residual.size());
    if (m_levels.size() > 2 && m_levels[1]->columns() >= krylov_columns)
        m_levels[1]->prepare_conjugate_gradients();
}

Multigrid::~Multigrid() = default;

const ColumnOrder& Multigrid::order() const { return m_levels.front()->order; }

MatrixArrays Multigrid::matrix() { return m_levels.front()->matrix(); }

void Multigrid::set_matrix_zero() {
    Level& fine = *m_levels.front();
    constexpr std::size_t kBlock = std::size_t{1} << 18U;
    for (AlignedArray<float>* array : {&fine.diagonal, &fine.lower})
        parallel_blocks(array->size(), kBlock, [array](std::size_t begin, std::size_t end) {
            std::fill(array->data() + begin, array->data() + end, 0.0F);
        });
}

bool Multigrid::set_up_smoother(Level& level) {
    const MatrixArrays matrix = level.matrix();
    level.matrix_scale = half_precision_scale(largest_magnitude(level.lower, level.lower.size()));
    const SmootherArrays smoother = level.smoother();
    std::atomic<bool> definite{true};
    parallel_blocks(level.columns(), kBlockColumns, [&](std::size_t begin, std::size_t end) {
        if (!definite) return;
        const Range columns = range_of(begin, end);
        if (m_table.pack_inverses(matrix, smoother, columns))
            m_table.pack_lower(matrix, smoother, columns);
        else
            definite = false;
    });
    return definite;
}

bool Multigrid::set_up() {
    if (!set_up_smoother(*m_levels.front())) return false;
    for (std::size_t l = 1; l < m_levels.size(); ++l) {
        Level& fine = *m_levels[l - 1];
        Level& coarse = *m_levels[l];
        constexpr std::size_t kBlock = 32;
        parallel_blocks(coarse.columns(), kBlock, [&](std::size_t begin, std::size_t end) {
            m_table.galerkin(fine.matrix(), fine.upper(), fine.transfer(), coarse.matrix(),
                             range_of(begin, end));
        });
        if (!set_up_smoother(coarse)) return false;
    }
    return true;
}

double Multigrid::product(Level& level, const float* x, float* y) const {
    const MatrixArrays matrix = level.matrix();
    return schedule_sum(level.order.columns,
                        [&](Range range) { return m_table.product(matrix, x, y, range); });
}

double Multigrid::product(const float* x, float* y) const { return product(*m_levels.front(), x, y); }

void Multigrid::apply(const float* b, float* x) { cycle(0, b, x); }

void Multigrid::cycle(std::size_t l, const float* b, float* x) {
    Level& level = *m_levels[l];
    Level& coarse = *m_levels[l + 1];
    const MatrixArrays matrix = level.matrix();
    const SmootherArrays smoother = level.smoother();
    float* residual = level.residual.data();
    for_schedule(level.order.columns,
                 [&](Range range) { m_table.sweep_forward(matrix, smoother, b, x, residual, range); });
    parallel_blocks(coarse.columns(), kBlockColumns, [&](std::size_t begin, std::size_t end) {
        m_table.restrict_residual(level.transfer(), 1.0F / level.matrix_scale, residual, coarse.b.data(),
                                  range_of(begin, end));
    });
    solve(l + 1, coarse.b.data(), coarse.x.data());
    parallel_blocks(level.columns(), kBlockColumns, [&](std::size_t begin, std::size_t end) {
        m_table.prolong(level.transfer(), coarse.x.data(), x, residual, range_of(begin, end));
    });
    for_schedule_reversed(level.order.columns, [&](Range range) {
        m_table.sweep_backward(matrix, smoother, b, x, residual, range);
    });
}

void Multigrid::smooth(Level& level, const float* b, float* x) {
    const MatrixArrays matrix = level.matrix();
    const SmootherArrays smoother = level.smoother();
    float* residual = level.residual.data();
    for_schedule(level.order.columns,
                 [&](Range range) { m_table.sweep_forward(matrix, smoother, b, x, residual, range); });
    level.residual.set_zero();
    for_schedule_reversed(level.order.columns, [&](Range range) {
        m_table.sweep_backward(matrix, smoother, b, x, residual, range);
    });
}

void Multigrid::solve(std::size_t l, const float* b, float* x) {
    if (l + 1 == m_levels.size())
        solve_coarsest(b, x);
    else if (m_levels[l]->image.size() > 0)
        two_iterations(l, b, x);
    else
        cycle(l, b, x);
}

/// Conjugate gradients from zero with a cycle before each step (a K-cycle: Notay and Vassilevski 2008). Near
/// a bifurcation wrinkles move almost freely, and one cycle of the coarse levels that they live on corrects
/// them by far too little (two cycles without conjugate gradients are no better; on a second level two
/// iterations cost what they save). The preconditioner is thereby not quite linear, which the outer iteration
/// allows for.
void Multigrid::two_iterations(std::size_t l, const float* b, float* x) {
    Level& level = *m_levels[l];
    const std::size_t size = level.b.size();
    float* r = level.defect.data();
    float* p = level.corrected.data();
    float* q = level.image.data();
    cycle(l, b, x);
    const double bx = dot(b, x, size);
    const double curvature = product(level, x, q);
    if (!(bx > 0)) {
        std::fill(x, x + size, 0.0F);
        return;
    }
    // Where the coarse matrix is indefinite the cycle alone is still a direction of descent.
    if (!(curvature > 0)) return;
    const auto first = static_cast<float>(bx / curvature);
    for_elements(size, [=](std::size_t i) { r[i] = b[i] - first * q[i]; });
    cycle(l, r, p);
    const auto [rp, qp] = dots(r, q, p, size);
    double second_curvature = 0;
    if (rp > 0) {
        const auto beta = static_cast<float>(std::max(0.0, -qp / curvature));
        for_elements(size, [=](std::size_t i) { p[i] += beta * x[i]; });
        second_curvature = product(level, p, q);
    }
    if (!(second_curvature > 0)) {
        for_elements(size, [=](std::size_t i) { x[i] *= first; });
        return;
    }
    const auto second = static_cast<float>(rp / second_curvature);
    for_elements(size, [=](std::size_t i) { x[i] = first * x[i] + second * p[i]; });
}

/// Nearly exactly, by conjugate gradients: volume change over the whole fruit is seen on this level only, and
/// three plain sweeps instead cost the outer iteration up to twice as many steps.
void Multigrid::solve_coarsest(const float* b, float* x) {
    constexpr int kIterations = 40;
    constexpr double kTolerance = 1e-2;  // of the residual in the preconditioner's norm
    Level& level = *m_levels.back();
    const std::size_t size = level.b.size();
    float* r = level.defect.data();
    float* z = level.corrected.data();
    float* p = level.direction.data();
    float* q = level.image.data();
    std::copy(b, b + size, r);
    std::fill(x, x + size, 0.0F);
    level.direction.set_zero();
    double first = 0;
    double curvature = 1;
    for (int k = 0; k < kIterations; ++k) {
        smooth(level, r, z);
        const auto [rz, qz] = dots(r, q, z, size);
        if (k == 0) first = rz;
        if (!(rz > kTolerance * kTolerance * first)) return;
        const float beta = k == 0 ? 0.0F : static_cast<float>(std::max(0.0, -qz / curvature));
        for_elements(size, [=](std::size_t i) { p[i] = z[i] + beta * p[i]; });
        curvature = product(level, p, q);
        if (!(curvature > 0)) {
            // An indefinite coarse matrix: what has been found so far is still a direction of descent.
            if (k == 0) std::copy(z, z + size, x);
            return;
        }
        const auto alpha = static_cast<float>(rz / curvature);
        for_elements(size, [=](std::size_t i) { x[i] += alpha * p[i]; });
        subtract(alpha, q, r, size);
    }
}

}  // namespace windfall::drying
