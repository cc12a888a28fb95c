// A whole new branch: both ends with bark, normals and texture coordinates, in place. Every iteration has
// another seed, so that nothing of the one before can be used.
#include <benchmark/benchmark.h>

#include <cstdint>

#include "fracture/broken_branch.h"
#include "recipe/recipe.h"

namespace {

using namespace windfall;

/// The lattice of the paper's own measurements: rings x sectors; rows along the bark in proportion.
void set_lattice(benchmark::State& state, fracture::FractureParameters& p) {
    p.branch.rings = state.range(0);
    p.branch.sectors = state.range(1);
    p.branch.layers = std::max<std::int64_t>(8, state.range(0) / 2);
    p.output.piece = fracture::PiecePlace::Above;
}

void snap(benchmark::State& state, const char* preset) {
    fracture::FractureParameters p = recipe::load(preset).fracture;
    set_lattice(state, p);
    p = fracture::resolved(p);
    // As in an editor, memory stays from one branch to the next.
    static fracture::BreakEnds ends;
    static fracture::BreakWorkspace workspace;
    static std::int64_t seed = 0;
    for (auto _ : state) {
        p.seed = ++seed;
        fracture::make_branch(p, ends, workspace);
        benchmark::DoNotOptimize(ends.piece.normals.data());
        benchmark::ClobberMemory();
    }
    state.counters["vertices"] =
        static_cast<double>(ends.stub.positions.size() + ends.piece.positions.size());
    state.counters["faces"] = static_cast<double>(ends.stub.faces.size() + ends.piece.faces.size());
}

void lattices(benchmark::internal::Benchmark* b) {
    b->Args({40, 40})->Args({100, 100})->Args({200, 200})->Args({400, 1000});
    // One model an iteration, the median of twenty.
    b->Iterations(1)->Repetitions(20)->ReportAggregatesOnly()->Unit(benchmark::kMillisecond);
}

// The figures of the paper are made without bundles; its own times are 18, 85 and 354 ms.
BENCHMARK_CAPTURE(snap, height_model_fig15, "fig15")->Apply(lattices);
BENCHMARK_CAPTURE(snap, bundles_ailanthus, "ailanthus")->Apply(lattices);
BENCHMARK_CAPTURE(snap, bundles_cypress, "cypress")->Apply(lattices);
BENCHMARK_CAPTURE(snap, bundles_green_branch, "green-branch")->Apply(lattices);

}  // namespace

BENCHMARK_MAIN();
