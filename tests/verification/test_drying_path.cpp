// The way of a body through its equilibria: what must hold at every step, and that it is the same way every
// time.
#include "drying/drying_path.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.h"
#include "drying/checkpoint.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"

namespace windfall::drying {
namespace {

DryingPath fruit(DryingParameters parameters) {
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

TEST(DryingPath, WorkIsAccountedFor) {
    // Viscous work never falls; volume is what drying leaves, up to the bulk ratio.
    DryingPath path = fruit(coarse(16));
    path.advance(0.2, {});
    double work = 0;
    for (const StepRecord& record : path.state().history) {
        EXPECT_GE(record.viscous_work, work);
        EXPECT_GT(record.smallest_volume_ratio, 0);
        work = record.viscous_work;
    }
    EXPECT_GT(path.state().history.back().depth_rms, 0.1 * 0.04);
}

TEST(DryingPath, CancelLeavesTheLastEquilibrium) {
    DryingPath path = fruit(coarse(16));
    path.advance(0.05, {});
    const AlignedArray<double> before = path.state().displacements.front();
    std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    EXPECT_THROW(path.advance(0.06, context), Cancelled);
    EXPECT_TRUE(same_bits(before, path.state().displacements.front()));
    EXPECT_EQ(path.shrinkage(), 0.05);
    cancel = false;
    path.advance(0.06, context);
    EXPECT_EQ(path.shrinkage(), 0.06);
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
