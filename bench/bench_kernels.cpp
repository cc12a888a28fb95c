// The hot loops of drying at the base case's size (48 x 48 x 48 brick, 8 layers: 331,824 unknowns), each
// alone, on one and two threads. Bytes are those that a loop has to move when nothing but the vectors stays
// in the cache (docs/performance.md); items are unknowns. `read_memory` is what there is to be had.
#include <benchmark/benchmark.h>

#include <numeric>

#include "core/parallel.h"
#include "drying/drying_path.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

constexpr double kShrinkage = 0.01;

/// The base case after a first increment.
DryingPath base_case() {
    DryingParameters parameters;
    parameters.mesh.n = 48;
    const auto shape = make_shape(parameters.fruit);
    geometry::LayeredMesh mesh = make_mesh(parameters, *shape);
    add_noise(mesh, parameters);
    DryingPath path(std::move(mesh), parameters);
    path.advance(kShrinkage, {});
    return path;
}

/// Bytes of the matrices of one level: per column and per entry of the lower triangle, which has four to a
/// quad.
struct LevelBytes {
    double diagonal, lower, packed, vector;

    LevelBytes(const geometry::Lattice& cells, int layers) {
        const double quads = 2.0 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]);
        const double columns = quads + 2;
        const double entries = 4 * quads;
        diagonal = columns * 18 * layers * sizeof(float);
        lower = entries * 27 * layers * sizeof(float);
        packed = columns * inverse_vectors(layers) * layers * sizeof(std::uint16_t) + lower / 2;
        vector = columns * 3 * layers * sizeof(float);
    }
    double matrix() const { return diagonal + lower; }
};

class Body : public benchmark::Fixture {
  public:
    void SetUp(const benchmark::State&) override {
        // One body for all: the benchmarks leave it as it is.
        static DryingPath path = base_case();
        m_path = &path;
        m_elasticity = &path.elasticity();
        m_multigrid = &m_elasticity->multigrid();
        m_elasticity->assemble(displacement(), 1, kDamping);
        if (!m_multigrid->set_up()) throw std::logic_error("the base case's tangent is not definite");
        m_force = AlignedArray<double>(m_elasticity->size());
        m_x = AlignedArray<float>(m_elasticity->size());
        m_y = AlignedArray<float>(m_elasticity->size());
        for (std::size_t i = 0; i < m_x.size(); ++i) m_x[i] = static_cast<float>(displacement()[i]);
    }

  protected:
    static constexpr double kDamping = 30;

    const AlignedArray<double>& displacement() const { return m_path->state().displacements.front(); }
    LevelBytes finest() const { return {m_path->mesh().brick.cells, m_path->mesh().layers}; }
    template <class Term>
    double sum_over_levels(Term term) const {
        geometry::Lattice cells = m_path->mesh().brick.cells;
        const int layers = m_path->mesh().layers;
        double sum = term(LevelBytes(cells, layers));
        for (; geometry::can_coarsen(cells); sum += term(LevelBytes(cells, layers)))
            cells = geometry::coarser(cells);
        return sum;
    }
    /// Positions, displacements, forces and drying tensors that the element loops read and write.
    double element_bytes() const {
        const auto quads = static_cast<double>(m_path->mesh().brick.quads.size());
        return 3 * 2 * finest().vector + quads * 7 * m_path->mesh().layers * sizeof(double);
    }
    template <class Loop>
    void time(benchmark::State& state, double bytes, Loop loop) {
        const ThreadLimit limit(static_cast<int>(state.range(0)));
        for (auto _ : state) loop();
        const auto iterations = static_cast<double>(state.iterations());
        state.SetBytesProcessed(static_cast<std::int64_t>(iterations * bytes));
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(m_elasticity->size()));
        state.counters["MB"] = bytes * 1e-6;
    }

    DryingPath* m_path = nullptr;
    Elasticity* m_elasticity = nullptr;
    Multigrid* m_multigrid = nullptr;
    AlignedArray<double> m_force;
    AlignedArray<float> m_x, m_y;
};

BENCHMARK_DEFINE_F(Body, energy)(benchmark::State& state) {
    time(state, element_bytes(),
         [&] { benchmark::DoNotOptimize(m_elasticity->energy(displacement(), &m_force)); });
}

BENCHMARK_DEFINE_F(Body, assemble)(benchmark::State& state) {
    // The matrix is set to zero, then read and written.
    time(state, element_bytes() + 3 * finest().matrix(),
         [&] { m_elasticity->assemble(displacement(), 1, kDamping); });
}

BENCHMARK_DEFINE_F(Body, multigrid_set_up)(benchmark::State& state) {
    // Lower blocks are gone through twice, for the largest entry and for packing; a level's matrix is read
    // again for the next coarser one, its lower triangle twice.
    const double smoothers = sum_over_levels(
        [](const LevelBytes& level) { return level.diagonal + 2 * level.lower + level.packed; });
    const double coarse = sum_over_levels(
        [](const LevelBytes& level) { return level.diagonal + 2 * level.lower + level.matrix() / 4; });
    time(state, smoothers + coarse, [&] { benchmark::DoNotOptimize(m_multigrid->set_up()); });
}

BENCHMARK_DEFINE_F(Body, cycle)(benchmark::State& state) {
    time(state, sum_over_levels([](const LevelBytes& level) { return 2 * level.packed; }),
         [&] { m_multigrid->apply(m_x.data(), m_y.data()); });
}

BENCHMARK_DEFINE_F(Body, product)(benchmark::State& state) {
    time(state, finest().matrix(), [&] { m_multigrid->product(m_x.data(), m_y.data()); });
}

/// What the machine's memory gives: reads far more than its caches hold.
void read_memory(benchmark::State& state) {
    constexpr std::size_t kFloats = std::size_t{160} << 20U;
    constexpr std::size_t kBlock = std::size_t{1} << 18U;
    const ThreadLimit limit(static_cast<int>(state.range(0)));
    AlignedArray<float> array(kFloats);
    for (float& x : array) x = 1;
    for (auto _ : state)
        benchmark::DoNotOptimize(parallel_sum(kFloats, kBlock, [&](std::size_t begin, std::size_t end) {
            constexpr std::size_t kLanes = 64;
            float sums[kLanes] = {};
            for (std::size_t i = begin; i < end; i += kLanes)
                for (std::size_t k = 0; k < kLanes; ++k) sums[k] += array[i + k];
            return static_cast<double>(std::accumulate(sums, sums + kLanes, 0.0F));
        }));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kFloats * sizeof(float)));
}

void on_one_and_two_threads(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(read_memory)->Apply(on_one_and_two_threads);
BENCHMARK_REGISTER_F(Body, energy)->Apply(on_one_and_two_threads);
BENCHMARK_REGISTER_F(Body, assemble)->Apply(on_one_and_two_threads);
BENCHMARK_REGISTER_F(Body, multigrid_set_up)->Apply(on_one_and_two_threads);
BENCHMARK_REGISTER_F(Body, cycle)->Apply(on_one_and_two_threads);
BENCHMARK_REGISTER_F(Body, product)->Apply(on_one_and_two_threads);

}  // namespace
}  // namespace windfall::drying

BENCHMARK_MAIN();
