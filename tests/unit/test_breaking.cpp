// The break as a motion: it starts at rest, tears from the tension side, falls, and lies on the ground.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/parallel.h"
#include "fracture/bark_walls.h"
#include "fracture/breaking_motion.h"
#include "fracture/placing.h"

namespace windfall::fracture {
namespace {

/// A branch so thick that its slow fall takes few steps; the motion of a thin one is the same, only faster.
FractureParameters thick_branch() {
    FractureParameters p;
    p.branch.diameter_m = 5;
    p.branch.rings = 12;
    p.branch.sectors = 36;
    p.branch.layers = 6;
    p.branch.length = 3;
    p.branch.piece_length = 4;
    p.bundles.radial = {0.35, 0.15};
    p.bundles.angular = {0.8, 0.25};
    p.bundles.amplitude = {0.8, 0.6};
    p.bundles.slope = {1, 2};
    p.fringe.strands = 60;
    p.load = {LoadSource::Bending, 200, 0};
    p.output.motion = Motion::Breaking;
    p.output.frames = 49;
    p.output.seconds = 7;
    return with_load(p);
}

struct Scene {
    FractureParameters parameters;
    BreakEnds ends;
    RestShape shape;
    explicit Scene(const FractureParameters& p) : parameters(p) {
        BreakWorkspace workspace;
        make_break_ends(p, ends, workspace);
        add_bark_walls(p, ends);
        shape = [limb = LimbShape(p, ends.lowest, ends.highest)](std::span<Vector3f> points) {
            limb.apply(points);
        };
    }
    BranchBreaking breaking() const { return {parameters, ends, shape}; }
    std::vector<Vector3f> rest(std::vector<Vector3f> points) const {
        shape(points);
        return points;
    }
};

std::vector<BreakingFrame> all_frames(const Scene& scene) {
    BranchBreaking breaking = scene.breaking();
    std::vector<BreakingFrame> frames;
    for (int f = 0; f < breaking.frame_count(); ++f) {
        breaking.advance_to(f, {});
        frames.push_back(breaking.frame());
    }
    return frames;
}

/// The thick branch's whole motion.
struct WholeMotion {
    Scene scene{thick_branch()};
    BranchBreaking breaking = scene.breaking();
    std::vector<BreakingFrame> frames;
    std::vector<double> heights;  ///< of the piece's centre of mass
    WholeMotion() {
        const LatticeEnd& piece = breaking.lattice().piece;
        for (int f = 0; f < breaking.frame_count(); ++f) {
            breaking.advance_to(f, {});
            frames.push_back(breaking.frame());
            heights.push_back(RigidMotion::of(breaking.particles(), piece.first, piece.past()).centre.z());
        }
    }
};

bool same(const std::vector<Vector3f>& a, const std::vector<Vector3f>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

bool same(const BreakingFrame& a, const BreakingFrame& b) {
    return a.time == b.time && same(a.stub, b.stub) && same(a.piece, b.piece) && same(a.fibres, b.fibres);
}

float lowest(const std::vector<Vector3f>& positions) {
    float z = positions[0].z();
    for (const Vector3f& p : positions) z = std::min(z, p.z());
    return z;
}

Vector3f mean(const std::vector<Vector3f>& positions) {
    Vector3f sum = Vector3f::Zero();
    for (const Vector3f& p : positions) sum += p;
    return sum / static_cast<float>(positions.size());
}

double farthest(const std::vector<Vector3f>& a, const std::vector<Vector3f>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, static_cast<double>((a[i] - b[i]).norm()));
    return most;
}

void expect_rest_at_first(const WholeMotion& m) {
    const BreakingFrame& first = m.frames[0];
    EXPECT_EQ(first.time, 0);
    EXPECT_EQ(first.bonds_holding, 1);
    EXPECT_LT(farthest(first.stub, m.scene.rest(m.scene.ends.stub.positions)), 1e-5);
    EXPECT_LT(farthest(first.piece, m.scene.rest(m.scene.ends.piece.positions)), 1e-5);
    EXPECT_TRUE(same(first.fibres, m.breaking.fibres().positions));
    // So both ends fit: they share the broken surface.
    for (std::int32_t v = 0; v < m.scene.ends.surface_vertices; ++v) {
        const auto i = static_cast<std::size_t>(v);
        if (m.scene.ends.stub.positions[i] != m.scene.ends.piece.positions[i]) continue;
        EXPECT_LT((first.stub[i] - first.piece[i]).norm(), 1e-5F);
    }
}

void expect_fall_towards_load(const WholeMotion& m) {
    const double ground = m.breaking.lattice().ground;
    const Vector3f moved = mean(m.frames.back().piece) - mean(m.frames[0].piece);
    const double towards = 200 * std::numbers::pi / 180;
    EXPECT_GT(moved.x() * std::cos(towards) + moved.y() * std::sin(towards), 1);
    EXPECT_LT(mean(m.frames.back().piece).z(), ground + 1.5);
    EXPECT_NEAR(lowest(m.frames.back().piece), ground, 0.02);
    EXPECT_LT(farthest(m.frames.back().piece, m.frames[m.frames.size() - 2].piece), 0.05);  // lies still
    EXPECT_EQ(m.frames.back().bonds_holding, 0);
    EXPECT_EQ(m.frames.back().fibres_bridging, 0);
    // The stub stands where it stood.
    EXPECT_LT(farthest(m.frames.back().stub, m.frames[0].stub), 0.05);
}

void expect_nothing_below_ground(const WholeMotion& m) {
    const auto ground = static_cast<float>(m.breaking.lattice().ground);
    for (const BreakingFrame& frame : m.frames)
        for (const auto* mesh : {&frame.stub, &frame.piece, &frame.fibres}) {
            EXPECT_GE(lowest(*mesh), ground);
            for (const Vector3f& p : *mesh) ASSERT_TRUE(p.allFinite());
        }
    GroundContact contact(m.breaking.lattice());
    ASSERT_GT(contact.particles().size(), 200U);
    for (std::size_t i : contact.particles())
        EXPECT_GE(m.breaking.particles().position[i].z(), m.breaking.lattice().ground - 1e-9);
}

void expect_tearing_from_tension_side(const WholeMotion& m) {
    const BreakingLattice& lattice = m.breaking.lattice();
    const TensionField field = tension_field(m.scene.parameters);
    double sums[3] = {0, 0, 0}, counts[3] = {0, 0, 0};
    double first = 1e9, first_side = 0;
    std::map<double, int> at_once;
    for (std::size_t c = 0; c < lattice.plan.size(); ++c) {
        const double side = lattice.plan.x(c) * field.cos_a + lattice.plan.y(c) * field.sin_a;
        const double time = m.breaking.bonds().torn_at[c];
        ASSERT_GT(time, 0);
        const int third = side < -1.0 / 3 ? 0 : (side < 1.0 / 3 ? 1 : 2);
        sums[third] += time;
        counts[third] += 1;
        ++at_once[time];
        if (time < first) {
            first = time;
            first_side = side;
        }
    }
    EXPECT_GT(first_side, 0.3);
    EXPECT_LT(sums[2] / counts[2], sums[1] / counts[1]);
    EXPECT_LT(sums[1] / counts[1], sums[0] / counts[0]);
    EXPECT_GT(at_once.size(), lattice.plan.size() / 2);
    EXPECT_GT(at_once.rbegin()->first - first, 0.05 * m.scene.parameters.output.seconds);
}

void expect_closed_fibres_that_tear(const WholeMotion& m) {
    const BranchMesh& mesh = m.breaking.fibres();
    std::map<std::pair<int, int>, int> edges;
    for (const geometry::Face& face : mesh.faces)
        for (int i = 0; i < geometry::corner_count(face); ++i)
            ++edges[{face[static_cast<std::size_t>(i)],
                     face[static_cast<std::size_t>((i + 1) % geometry::corner_count(face))]}];
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
    ASSERT_EQ(mesh.parts.size(), mesh.faces.size());
    ASSERT_EQ(mesh.height.size(), mesh.positions.size());

    constexpr std::size_t kHalf = 47, kTip = 46;  // vertices of a half; the centre of its tip
    const std::size_t fibres = mesh.positions.size() / (2 * kHalf);
    ASSERT_GE(fibres, 20U);
    std::set<int> torn_in;
    for (std::size_t i = 0; i < fibres; ++i) {
        int torn = -1;
        for (std::size_t f = 0; f < m.frames.size(); ++f) {
            const auto& p = m.frames[f].fibres;
            const bool apart = (p[2 * i * kHalf + kTip] - p[(2 * i + 1) * kHalf + kTip]).norm() > 1e-5F;
            if (apart && torn < 0) torn = static_cast<int>(f);
        }
        ASSERT_GT(torn, 0);
        torn_in.insert(torn);
    }
    EXPECT_GE(torn_in.size(), 4U);  // not all at once
}

void expect_free_fall(const WholeMotion& m) {
    EXPECT_NEAR(m.breaking.lattice().gravity, 9.81 / 2.5, 1e-12);  // radii/s^2
    // From letting go until it touches something: s = g t^2 / 2, so the second difference is - g dt^2.
    const double dt = m.frames[1].time;
    int falling = 0;
    for (std::size_t f = 1; f + 1 < m.frames.size(); ++f) {
        const double acceleration = (m.heights[f + 1] - 2 * m.heights[f] + m.heights[f - 1]) / (dt * dt);
        const bool free = m.frames[f - 1].bonds_holding == 0;
        if (free && std::abs(acceleration / m.breaking.lattice().gravity + 1) < 0.01) ++falling;
    }
    EXPECT_GE(falling, 4);
}

void expect_shape_kept(const WholeMotion& m) {
    // Distances within each end, away from the break: wood neither stretches nor collapses, not even at
    // impact.
    const auto distortion = [&](const BranchMesh& mesh, std::vector<Vector3f> BreakingFrame::*positions,
                                bool above) {
        std::vector<std::size_t> far;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const float z = mesh.positions[v].z();
            if (above ? z > m.scene.ends.highest + 0.2 : z < m.scene.ends.lowest - 0.2) far.push_back(v);
        }
        double most = 0;
        for (const BreakingFrame& frame : m.frames)
            for (std::size_t i = 0; i < far.size(); ++i) {
                const std::size_t a = far[i], b = far[(i * 7 + far.size() / 2) % far.size()];
                const float rest = ((m.frames[0].*positions)[a] - (m.frames[0].*positions)[b]).norm();
                const float now = ((frame.*positions)[a] - (frame.*positions)[b]).norm();
                if (rest > 1) most = std::max(most, std::abs(static_cast<double>(now / rest) - 1));
            }
        EXPECT_GT(far.size(), 100U);
        return most;
    };
    EXPECT_LT(distortion(m.scene.ends.stub, &BreakingFrame::stub, false), 0.1);
    EXPECT_LT(distortion(m.scene.ends.piece, &BreakingFrame::piece, true), 0.1);
}

TEST(Breaking, BendsOpensTearsFallsAndLies) {
    const WholeMotion motion;
    expect_rest_at_first(motion);
    expect_fall_towards_load(motion);
    expect_nothing_below_ground(motion);
    expect_tearing_from_tension_side(motion);
    expect_closed_fibres_that_tear(motion);
    expect_free_fall(motion);
    expect_shape_kept(motion);
}

TEST(Breaking, ResumingFramesAndThreadsChangeNoBit) {
    const Scene scene(thick_branch());
    BranchBreaking whole = scene.breaking();
    std::vector<BreakingFrame> frames;
    std::vector<std::vector<std::byte>> states;
    for (int f = 0; f < 25; ++f) {
        whole.advance_to(f, {});
        frames.push_back(whole.frame());
        states.push_back(whole.save());
    }
    EXPECT_LT(frames[20].bonds_holding, 1);  // while it tears
    for (std::size_t from : {std::size_t{0}, std::size_t{18}, std::size_t{20}}) {
        BranchBreaking resumed = scene.breaking();
        resumed.restore(states[from]);
        EXPECT_EQ(resumed.frame_index(), static_cast<int>(from));
        EXPECT_TRUE(same(resumed.frame(), frames[from]));
        resumed.advance_to(static_cast<int>(from) + 4, {});
        EXPECT_TRUE(same(resumed.frame(), frames[from + 4]));
        EXPECT_EQ(resumed.save(), states[from + 4]);
    }

    FractureParameters coarse = thick_branch();
    coarse.output.frames = 25;
    const ThreadLimit one(1);
    BranchBreaking half = Scene(coarse).breaking();
    for (int f = 0; f <= 12; ++f) {
        half.advance_to(f, {});
        EXPECT_TRUE(same(half.frame(), frames[2 * static_cast<std::size_t>(f)])) << f;
    }

    // The state of another break is refused.
    FractureParameters p = thick_branch();
    p.output.seconds = 5;
    BranchBreaking other = Scene(p).breaking();
    EXPECT_THROW(other.restore(states[3]), InputError);
    EXPECT_THROW(half.restore(std::span(states[3]).first(1000)), InputError);
    EXPECT_THROW(half.restore({}), InputError);
}

TEST(Breaking, CanBeCancelled) {
    BranchBreaking breaking = Scene(thick_branch()).breaking();
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    EXPECT_THROW(breaking.advance_to(5, context), Cancelled);
    EXPECT_EQ(breaking.frame_index(), 0);
}

TEST(Breaking, WetWoodBendsFartherBeforeItTears) {
    FractureParameters wet = thick_branch();
    wet.species.moisture = Moisture::Wet;
    wet.output.seconds = 3;
    wet.output.frames = 25;
    FractureParameters dry = wet;
    dry.species.moisture = Moisture::Dry;
    const auto first_tear = [](const FractureParameters& p) {
        BranchBreaking breaking = Scene(p).breaking();
        for (int f = 0; f < breaking.frame_count(); ++f) {
            breaking.advance_to(f, {});
            if (breaking.bonds().holding() < breaking.bonds().size()) return breaking.frame().time;
        }
        return 1e9;
    };
    EXPECT_GT(first_tear(wet), first_tear(dry) + 0.1);
}

TEST(Breaking, ExtremeParametersStayFinite) {
    std::vector<FractureParameters> cases(6, thick_branch());
    cases[0].branch.diameter_m = 1e-3;
    cases[0].output.seconds = 0.04;
    cases[1].load.twist = 10;
    cases[1].output.seconds = 1;
    cases[2].fracture.tilt_deg = 80;
    cases[2].load.source = LoadSource::ByHand;
    cases[2].output.seconds = 0.6;
    cases[3].branch.length = cases[3].branch.piece_length = 0.05;
    cases[3].output.seconds = 0.6;
    cases[4].bundles.amplitude = {12, 8};
    cases[4].fringe.strand_length = 20;
    cases[4].output.seconds = 0.1;
    cases[5].bundles.radial = cases[5].bundles.angular = cases[5].bundles.amplitude =
        cases[5].bundles.slope = {};
    cases[5].branch.bend_deg = 60;
    cases[5].branch.length = 30;
    cases[5].output.seconds = 0.01;
    for (FractureParameters& p : cases) {
        p.output.frames = 4;
        for (const BreakingFrame& frame : all_frames(Scene(p)))
            for (const auto* mesh : {&frame.stub, &frame.piece, &frame.fibres})
                for (const Vector3f& v : *mesh) ASSERT_TRUE(v.allFinite());
    }
}

}  // namespace
}  // namespace windfall::fracture
