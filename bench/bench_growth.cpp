// Growth of soft rot and mould on a ball: the cost of one step where the whole skin is at work, by texture
// size, and of an hour's frame over three weeks. Times in milliseconds of wall clock.
//   bench_growth [--benchmark_filter=...]
#include <benchmark/benchmark.h>

#include <vector>

#include "core/parallel.h"
#include "decay/colonies.h"
#include "decay/growth.h"

namespace {

using namespace windfall;
using decay::Growth;
using geometry::Vec3;

constexpr double kRadius_m = 0.035;

Growth growth_on_ball(const geometry::CubeAtlas& atlas) {
    std::vector<Vec3> positions(atlas.texel_count(), Vec3::Zero());
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (atlas.covered(i)) positions[i] = kRadius_m * atlas.texel_direction(i);
    return {atlas,
            positions,
            {decay::soft_rot_organism(decay::species_named("erwinia")),
             decay::fungus_organism(decay::species_named("penicillium-digitatum"))},
            {},
            1};
}

/// One explicit-sized step, gate open everywhere: arguments are the texture's side and the threads.
void one_step(benchmark::State& state) {
    const ThreadLimit limit(static_cast<int>(state.range(1)));
    const geometry::CubeAtlas atlas(static_cast<int>(state.range(0)));
    Growth growth = growth_on_ball(atlas);
    const std::size_t middle = growth.nearest_texel(Vec3(kRadius_m, 0, 0));
    for (std::size_t o = 0; o < 2; ++o) growth.plant(o, middle, 3 * kRadius_m, 0.25);
    // The stable step of an explicit scheme at 512, and its quarter for each doubling: two stages are enough.
    const double step_h = 0.02 * 512.0 * 512.0 / static_cast<double>(state.range(0) * state.range(0));
    for (int warm = 0; warm < 5; ++warm) growth.advance(step_h, {});  // memory is touched, the gate open
    for (auto _ : state) growth.advance(step_h, {});
    state.counters["active share"] = growth.active_share();
    state.counters["texels/s"] = benchmark::Counter(static_cast<double>(growth.texel_count()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
    state.counters["passes/step"] =
        static_cast<double>(growth.pass_count()) / static_cast<double>(growth.step_count());
}
BENCHMARK(one_step)
    ->ArgsProduct({{512, 1024, 2048, 4096}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20)  // a skin of 4096 texels a side takes much longer to lay out than to step
    ->UseRealTime();

/// 500 frames of an hour from two wounds; the time is that of all.
void frames_500(benchmark::State& state) {
    const ThreadLimit limit(static_cast<int>(state.range(1)));
    const geometry::CubeAtlas atlas(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        Growth growth = growth_on_ball(atlas);
        decay::Colonies colonies({}, 3);
        for (const Vec3& d : {Vec3(1, 0.3, 0.2), Vec3(0.8, -0.5, 0.4)})
            for (std::size_t o = 0; o < 2; ++o)
                colonies.start(growth, {kRadius_m * d.normalized(), o, 0.3, 0.0015});
        const double start = growth.total();
        for (int frame = 0; frame < 500; ++frame) {
            growth.advance(1, {});
            colonies.spread(growth);
        }
        state.counters["steps"] = static_cast<double>(growth.step_count());
        state.counters["passes"] = static_cast<double>(growth.pass_count());
        state.counters["planted and drifted"] = growth.total() / start - 1;
    }
}
BENCHMARK(frames_500)
    ->ArgsProduct({{512}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
