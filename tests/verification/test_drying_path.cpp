// The way of a body through its equilibria: what must hold at every step, and that it is the same way every
// time.
#include "drying/drying_path.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "core/parallel.h"
#include "drying/checkpoint.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

DryingPath fruit(const DryingParameters& parameters) {
    const auto shape = make_shape(parameters.fruit);
    geometry::LayeredMesh mesh = make_mesh(parameters, *shape);
    add_imperfection(mesh, parameters, {});
    return {std::move(mesh), parameters};
}

DryingParameters coarse(int n) {
    DryingParameters parameters;
    parameters.mesh.n = n;
    return parameters;
}

bool same_bits(const AlignedArray<double>& a, const AlignedArray<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

constexpr double kPastOnset = 0.11;

TEST(DryingPath, SameBitsForAnyThreadCount) {
    std::vector<AlignedArray<double>> results;
    for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        DryingPath path = fruit(coarse(24));
        path.advance(kPastOnset, {});
        ASSERT_GT(path.onset(), 0) << "the test must pass the bifurcation to mean anything";
        results.push_back(path.state().displacements.front());
    }
    EXPECT_TRUE(same_bits(results[0], results[1]));
    EXPECT_TRUE(same_bits(results[0], results[2]));
}

TEST(DryingPath, ResumesToTheSameBits) {
    DryingPath straight = fruit(coarse(16));
    straight.advance(0.07, {});
    straight.advance(0.12, {});

    DryingPath first = fruit(coarse(16));
    first.advance(0.07, {});
    const auto bytes = to_bytes({first.state(), 3, 12.5});
    DryingPath second = fruit(coarse(16));
    Checkpoint checkpoint = checkpoint_from(bytes, second.elasticity().size());
    EXPECT_EQ(checkpoint.frames_done, 3);
    EXPECT_EQ(checkpoint.elapsed_s, 12.5);
    second.set_state(std::move(checkpoint.path));
    second.advance(0.12, {});
    EXPECT_TRUE(same_bits(straight.state().displacements.front(), second.state().displacements.front()));
    EXPECT_EQ(straight.state().history.size(), second.state().history.size());
}

TEST(DryingPath, BrokenCheckpointsAreRefused) {
    DryingPath path = fruit(coarse(8));
    path.advance(0.01, {});
    const auto bytes = to_bytes({path.state(), 1, 0});
    const std::size_t size = path.elasticity().size();
    EXPECT_NO_THROW(checkpoint_from(bytes, size));
    EXPECT_THROW(checkpoint_from(bytes, size + 24), InputError);
    EXPECT_THROW(checkpoint_from(std::span(bytes).first(bytes.size() - 8), size), InputError);
    EXPECT_THROW(checkpoint_from(std::span(bytes).first(4), size), InputError);
    auto damaged = bytes;
    damaged[12] ^= std::byte{0xff};
    EXPECT_THROW(checkpoint_from(damaged, size), InputError);
}

/// Viscous work of an increment from its two ends: sum of c M du (du - step slow) / dt.
double viscous_work_between(DryingPath& path, const AlignedArray<double>& from,
                            const AlignedArray<double>& slow, double step, double factor) {
    const AlignedArray<double>& to = path.state().displacements.front();
    const auto layers = static_cast<std::size_t>(path.mesh().layers);
    double work = 0;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const double motion = to[i] - from[i];
        work += factor * path.elasticity().mass()[i / (3 * layers) * layers + i % layers] * motion *
                (motion - step * slow[i]);
    }
    return work;
}

TEST(DryingPath, ViscousWorkIsThatOfTheIncrements) {
    DryingParameters parameters = coarse(8);
    parameters.solver.viscosity = parameters.solver.late_viscosity = 2;
    DryingPath path = fruit(parameters);
    double expected = 0;
    double last_shrinkage = 0;
    AlignedArray<double> from = path.state().displacements.front();
    AlignedArray<double> slow(from.size());  // motion by unit shrinkage that is not damped
    path.advance(0.05, {}, [&] {
        const double step = path.shrinkage() - last_shrinkage;
        expected += viscous_work_between(path, from, slow, step, 2 * parameters.drying.shrinkage / step);
        from = path.state().displacements.front();
        slow = path.drift(step);
        for (std::size_t i = 0; i < from.size(); ++i) slow[i] = (slow[i] - from[i]) / step;
        last_shrinkage = path.shrinkage();
        EXPECT_NEAR(path.state().history.back().viscous_work, expected, 1e-9 * expected);
    });
    EXPECT_GT(expected, 1e-3);
}

TEST(DryingPath, SlowShrinkingOfTheWholeFruitIsNotDamped) {
    // A perfect sphere stays a sphere: all its motion is slow, and after the first increment, which knows of
    // none, each is damped only by what the motion changes from one to the next.
    DryingParameters parameters = coarse(8);
    parameters.solver.viscosity = 5;
    parameters.imperfection.kind = ImperfectionKind::None;
    DryingPath path = fruit(parameters);
    path.advance(0.05, {});
    const std::vector<StepRecord>& history = path.state().history;
    ASSERT_GE(history.size(), 4U);
    const double first = history[0].viscous_work;
    EXPECT_GT(first, 0);
    EXPECT_LT(history.back().viscous_work - history[1].viscous_work, 0.01 * first);
}

TEST(DryingPath, CancelInTheMiddleChangesNothingOfTheWay) {
    DryingPath path = fruit(coarse(16));
    path.advance(0.08, {});
    std::atomic<bool> cancel{false};
    RunContext context;
    context.cancel = &cancel;
    // The flag is raised while increments are being solved, again and again until the way is done.
    int cancelled = 0;
    while (path.shrinkage() < 0.11) {
        cancel = false;
        std::thread other([&cancel] {
            std::this_thread::sleep_for(std::chrono::milliseconds(40));
            cancel = true;
        });
        try {
            path.advance(0.11, context);
        } catch (const Cancelled&) {
            ++cancelled;
        }
        other.join();
        ASSERT_LT(cancelled, 1000);
        if (cancelled >= 5) context.cancel = nullptr;
    }
    EXPECT_GT(cancelled, 0);
    DryingPath straight = fruit(coarse(16));
    straight.advance(0.08, {});
    straight.advance(0.11, {});
    EXPECT_TRUE(same_bits(straight.state().displacements.front(), path.state().displacements.front()));
}

TEST(DryingPath, LostEquilibriumSaysWhereAndWhatToTry) {
    // Without damping the bifurcation of a perfect body cannot be passed.
    DryingParameters parameters = coarse(16);
    parameters.solver.viscosity = parameters.solver.late_viscosity = 0;
    parameters.imperfection.kind = ImperfectionKind::None;
    DryingPath path = fruit(parameters);
    try {
        path.advance(0.3, {});
        FAIL() << "a perfect body passed its bifurcation without damping";
    } catch (const RunError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("shrinkage 0."), std::string::npos);
        EXPECT_NE(text.find("solver.viscosity"), std::string::npos);
    }
    EXPECT_GT(path.shrinkage(), 0.08);
    EXPECT_LT(path.shrinkage(), 0.13);
}

TEST(DryingPath, EqualShrinkingOfSkinAndFleshLeavesNoWrinkles) {
    DryingParameters parameters = coarse(16);
    parameters.drying.skin_fraction = 1;
    DryingPath path = fruit(parameters);
    path.advance(0.2, {});
    EXPECT_LT(path.state().history.back().depth_rms, 0.02 * parameters.fruit.skin_thickness);
}

TEST(DryingPath, SixteenLayersAgreeWithEight) {
    DryingParameters parameters = coarse(16);
    DryingPath eight = fruit(parameters);
    parameters.mesh.layers = 16;
    DryingPath sixteen = fruit(parameters);
    eight.advance(0.06, {});
    sixteen.advance(0.06, {});
    const double e8 = eight.state().history.back().elastic_energy;
    const double e16 = sixteen.state().history.back().elastic_energy;
    EXPECT_NEAR(e8, e16, 0.01 * e8);
}

}  // namespace
}  // namespace windfall::drying
