// One frame of a fruit's body (flesh of 19,200 tetrahedra, skin of 10,088 or 40,346 vertices) in the middle
// of a run over 500 frames that loses 35 % of its volume, the making of the preconditioner beside it
// included.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/parallel.h"
#include "decay/body.h"

namespace windfall::decay {
namespace {

constexpr int kFrames = 500;

/// range(0): skin cells; range(1): threads.
void frame_of_a_tomato(benchmark::State& state) {
    const ThreadLimit limit(static_cast<int>(state.range(1)));
    const auto surface = [](const geometry::Vec3& d) -> geometry::Vec3 {
        return 0.037 * geometry::Vec3(d.x(), d.y(), 0.82 * d.z());
    };
    BodySettings settings;
    settings.softening = 1.0 / 40;
    settings.skin_cells = static_cast<int>(state.range(0));
    Body body(surface, settings);
    body.settle({});
    int frame = 0;
    for (auto _ : state) {
        const double share = std::min(1.0, ++frame / static_cast<double>(kFrames));
        body.advance({.water_fraction_lost = 0.35 * share, .progress = share});
    }
    state.counters["skin vertices"] = static_cast<double>(body.skin().size());
    state.counters["height mm"] = 1e3 * body.height_m();
}

BENCHMARK(frame_of_a_tomato)
    ->ArgsProduct({{41, 82}, {1, 2}})
    ->Iterations(200)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace windfall::decay

BENCHMARK_MAIN();
