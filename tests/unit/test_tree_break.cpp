#include "fracture/tree_break.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "fracture/tree_surface.h"
#include "meshfile/mesh_file.h"
#include "support/mesh_checks.h"
#include "support/message_of.h"
#include "support/test_trees.h"

namespace windfall::fracture {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using meshfile::Mesh;
using ::testing::Contains;
using ::testing::HasSubstr;

FractureParameters small_break() {
    FractureParameters p;
    p.branch.rings = 12;
    p.branch.sectors = 40;
    p.branch.layers = 12;
    p.bundles.radial = {.5, .2};
    p.bundles.angular = {.9, .3};
    p.bundles.amplitude = {.3, .4};
    p.bundles.slope = {.3, .8};
    p.output.piece = PiecePlace::Above;
    return p;
}

/// Elliptic and bent: half axes 0.14 and 0.09 at the foot.
test::Tube bent_tube() {
    test::Tube tube;
    tube.centre = [](double t) { return Vec3(0.3 * t * t, 2 * t, 0.2 * t); };
    tube.half_axes = [](double t) { return Vec2(0.14 - 0.03 * t, 0.09 - 0.02 * t); };
    return tube;
}

Mesh bent_tree(bool by_groups) { return test::as_mesh(test::tube_tree(bent_tube()), by_groups); }
const Vec3 kOnBentTree(0.2, 1.0, 0.1);

const Mesh& forked_tree() {
    static const Mesh mesh = test::as_mesh(test::forked_tree(test::fork_limbs(), 0.04), false);
    return mesh;
}
const Vec3 kOnForkedTree(0.36, 2.6, 0);

TEST(TreeBreak, BothPartsAreClosedAndMakeUpTheTree) {
    FractureParameters p = small_break();
    for (const Mesh& mesh : {bent_tree(false), bent_tree(true), forked_tree()}) {
        ASSERT_EQ(test::bad_edges(mesh), 0U);
        const Vec3 at = mesh.face_count() > 1000 ? kOnForkedTree : kOnBentTree;
        const TreeBreak broken = break_tree(mesh, at, p);
        EXPECT_EQ(test::bad_edges(broken.tree), 0U);
        EXPECT_EQ(test::bad_edges(broken.piece), 0U);
        const double whole = test::volume(mesh), tree = test::volume(broken.tree),
                     piece = test::volume(broken.piece);
        EXPECT_GT(tree, 0.1 * whole);
        EXPECT_GT(piece, 0.1 * whole);
        // Chords of 40 sectors across the facets of the old bark.
        EXPECT_NEAR(tree + piece, whole, 1e-3 * whole);
    }
}

TEST(TreeBreak, TransformedAndMirroredNodesBreakAsTheyStandInTheWorld) {
    Mesh mesh = bent_tree(true);
    Eigen::Affine3d to_world = Eigen::Affine3d::Identity();
    to_world.translate(Vec3(3, 1, -2))
        .rotate(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()))
        .scale(Vec3(-2, 2, 3));
    for (meshfile::Group& group : mesh.groups) group.to_world = to_world;
    ASSERT_TRUE(mesh.groups[0].mirrored());
    const TreeBreak broken = break_tree(mesh, to_world * kOnBentTree, small_break());
    EXPECT_EQ(test::bad_edges(broken.tree), 0U);
    EXPECT_EQ(test::bad_edges(broken.piece), 0U);
    const double whole = test::volume(mesh);
    EXPECT_NEAR(test::volume(broken.tree) + test::volume(broken.piece), whole, 1e-3 * whole);
    EXPECT_GT(test::volume(broken.piece), 0.1 * whole);
    // Hard normals of the wood, brought to the world, are those of the faces.
    const std::vector<Vec3> world = broken.tree.world_positions();
    std::size_t looked_at = 0;
    for (std::size_t f = 0; f < broken.tree.face_count(); ++f) {
        if (broken.tree.materials[static_cast<std::size_t>(broken.tree.faces[f].material)].name != "fibres")
            continue;
        const std::size_t c = broken.tree.face_starts[f];
        const auto v = [&](std::size_t k) { return static_cast<std::size_t>(broken.tree.corners[c + k]); };
        Vec3 normal = (world[v(1)] - world[v(0)]).cross(world[v(2)] - world[v(0)]);
        if (broken.tree.corner_count(f) != 3 || normal.norm() < 1e-5) continue;
        const auto& values = broken.tree.attributes[0].values;
        const Vec3 local(values[3 * v(0)], values[3 * v(0) + 1], values[3 * v(0) + 2]);
        const Vec3 told = (to_world.linear().inverse().transpose() * local).normalized();
        EXPECT_NEAR(-told.dot(normal.normalized()), 1, 1e-2);  // corners are in the mirrored order
        ++looked_at;
    }
    EXPECT_GT(looked_at, 3U);
}

TEST(TreeBreak, ThornsStripsAndHighBreaksAreClosedToo) {
    FractureParameters p = small_break();
    p.thorns.sapwood_length = 0.8;
    p.thorns.sapwood_probability = 0.2;
    p.fracture.tilt_deg = 40;
    p.bundles.amplitude = {1.5, 1};
    p.fringe.strips = 3;
    p.output.piece = PiecePlace::Beside;
    const TreeBreak broken = break_tree(bent_tree(false), kOnBentTree, p);
    EXPECT_EQ(test::bad_edges(broken.tree), 0U);
    EXPECT_EQ(test::bad_edges(broken.piece), 0U);
}

TEST(TreeBreak, EndsFitWithoutOverlapAndNothingIsLost) {
    const Mesh mesh = bent_tree(false);
    const TreeBreak broken = break_tree(mesh, kOnBentTree, small_break());
    EXPECT_TRUE(broken.piece_shift.isZero());
    const auto whole = test::world_triangles(mesh), tree = test::world_triangles(broken.tree),
               piece = test::world_triangles(broken.piece);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int in_tree = 0, in_piece = 0;
    for (int i = 0; i < 150; ++i) {
        const Vec3 p = broken.branch.centre +
                       broken.branch.radius * Vec3(uniform(random), uniform(random), uniform(random));
        const double inside = test::winding(whole, p), left = test::winding(tree, p),
                     fell = test::winding(piece, p);
        // Next to the bark the new facets are not the old ones.
        if (std::abs(test::winding(whole, p * 0.97 + broken.branch.centre * 0.03) - inside) > 0.5) continue;
        if (std::abs(test::winding(whole, p * 1.03 - broken.branch.centre * 0.03) - inside) > 0.5) continue;
        EXPECT_NEAR(left + fell, inside, 1e-6) << p.transpose();
        EXPECT_NEAR(left * fell, 0, 1e-6);
        in_tree += left > 0.5 ? 1 : 0;
        in_piece += fell > 0.5 ? 1 : 0;
    }
    EXPECT_GT(in_tree, 10);
    EXPECT_GT(in_piece, 10);
}

TEST(TreeBreak, WhatLiesOutsideTheBreakStaysAsItWas) {
    for (const bool by_groups : {false, true}) {
        const Mesh mesh = bent_tree(by_groups);
        const TreeBreak broken = break_tree(mesh, kOnBentTree, small_break());
        const std::vector<Vec3> world = mesh.world_positions();
        for (const bool is_piece : {false, true}) {
            const Mesh& part = is_piece ? broken.piece : broken.tree;
            const std::vector<std::size_t> taken = test::faces_taken_over(mesh, part);
            std::size_t far = 0;
            for (std::size_t f = 0; f < mesh.face_count(); ++f) {
                bool is_far = true;
                for (std::size_t c = mesh.face_starts[f]; c < mesh.face_starts[f + 1]; ++c) {
                    const double along =
                        (world[static_cast<std::size_t>(mesh.corners[c])] - broken.branch.centre)
                            .dot(broken.branch.axis);
                    is_far = is_far && (is_piece ? along : -along) > 2.5 * broken.branch.radius;
                }
                if (!is_far) continue;
                ++far;
                EXPECT_THAT(taken, Contains(f));
            }
            EXPECT_GT(far, 50U);
            // The first vertices are those of the file, in its order, and new ones follow.
            std::size_t next = 0, kept = 0;
            for (const Vec3& p : mesh.positions)
                if (next < part.positions.size() && p == part.positions[next]) ++next;
            for (std::size_t c = 0; c < part.face_starts[taken.size()]; ++c)
                kept = std::max(kept, static_cast<std::size_t>(part.corners[c]) + 1);
            EXPECT_GE(next, kept);
            EXPECT_GT(kept, 50U);
        }
    }
}

TEST(TreeBreak, NewBarkLiesOnTheOldOneWithItsTexture) {
    const Mesh mesh = bent_tree(false);
    const TreeSurface surface = make_tree_surface(mesh);
    const TreeBreak broken = break_tree(mesh, kOnBentTree, small_break());
    const Mesh& tree = broken.tree;
    const std::size_t old_faces = test::faces_taken_over(mesh, tree).size();
    const meshfile::Attribute& vt = tree.attributes[1];
    ASSERT_EQ(vt.name, "vt");
    std::size_t bark_faces = 0;
    for (std::size_t f = old_faces; f < tree.face_count(); ++f) {
        if (tree.faces[f].material != 0) continue;
        ++bark_faces;
        double least = 1e9, most = -1e9;
        for (std::size_t c = tree.face_starts[f]; c < tree.face_starts[f + 1]; ++c) {
            const Vec3& p = tree.positions[static_cast<std::size_t>(tree.corners[c])];
            const SurfacePlace place = nearest_place(surface, p);
            EXPECT_LT((place.position - p).norm(), 1e-6);
            const double u = vt.values[2 * static_cast<std::size_t>(vt.corner_entries[c])];
            const double v = vt.values[2 * static_cast<std::size_t>(vt.corner_entries[c]) + 1];
            // Along the branch there is no seam: what the old bark says at the same place.
            const TreeTriangle& triangle = surface.triangles[static_cast<std::size_t>(place.triangle)];
            double expected = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                std::array<double, 5> values{};
                meshfile::corner_values(mesh, triangle.corners[k], values.data());
                expected += place.weights[static_cast<int>(k)] * values[4];
            }
            EXPECT_NEAR(v, expected, 1e-3);  // beside the seam charts are continued in their planes
            least = std::min(least, u);
            most = std::max(most, u);
        }
        // No face is smeared over the seam.
        EXPECT_LT(most - least, 0.2);
    }
    EXPECT_GT(bark_faces, 100U);
}

TEST(TreeBreak, MaterialsAreNamedAfterTheParts) {
    for (const bool by_groups : {false, true}) {
        const TreeBreak broken = break_tree(bent_tree(by_groups), kOnBentTree, small_break());
        std::vector<std::string> names;
        for (const meshfile::Material& material : broken.tree.materials) names.push_back(material.name);
        EXPECT_EQ(names[0], "bark");
        EXPECT_EQ(names[1], "moss");
        EXPECT_THAT(names, Contains("fibres"));
        std::vector<int> faces(names.size(), 0);
        for (const meshfile::FaceInfo& face : broken.tree.faces)
            ++faces[static_cast<std::size_t>(face.material)];
        for (const int count : faces) EXPECT_GT(count, 0);
        ASSERT_EQ(broken.piece.materials.size(), names.size());
        for (std::size_t m = 0; m < names.size(); ++m) EXPECT_EQ(broken.piece.materials[m].name, names[m]);
    }
}

TEST(TreeBreak, GapMovesThePieceAlongTheBranchAndBesidePutsItOnTheGround) {
    FractureParameters p = small_break();
    p.fracture.gap = 2;
    const TreeBreak apart = break_tree(bent_tree(false), kOnBentTree, p);
    EXPECT_NEAR((apart.piece_shift - 2 * apart.branch.radius * apart.branch.axis).norm(), 0, 1e-12);
    EXPECT_GT(apart.branch.axis.y(), 0.9);

    p.output.piece = PiecePlace::Beside;
    const TreeBreak fallen = break_tree(bent_tree(false), kOnBentTree, p);
    double ground = 1e9, lowest = 1e9;
    for (const Vec3& v : fallen.tree.positions) ground = std::min(ground, v.y());
    for (const Vec3& v : fallen.piece.positions) lowest = std::min(lowest, v.y() + fallen.piece_shift.y());
    EXPECT_NEAR(lowest, ground, 1e-9);

    p.output.piece = PiecePlace::Hidden;
    EXPECT_TRUE(break_tree(bent_tree(false), kOnBentTree, p).piece.faces.empty());
}

TEST(TreeBreak, ThePartWithTheLowestPointStaysUnlessAskedOtherwise) {
    FractureParameters p = small_break();
    const Mesh mesh = bent_tree(false);
    const Vec3 low(0.05, 0.5, 0.05);  // the upper part is the larger one
    EXPECT_GT(break_tree(mesh, low, p).branch.axis.y(), 0);
    TreeBreakOptions options;
    options.falls = FallingSide::Smaller;
    EXPECT_LT(break_tree(mesh, low, p, options).branch.axis.y(), 0);
    options.falls = FallingSide::AwayFromRoot;
    options.up = -Vec3::UnitY();
    EXPECT_LT(break_tree(mesh, low, p, options).branch.axis.y(), 0);
}

/// A small card at `place`, a body of its own.
void add_leaf(test::TestTree& tree, const Vec3& place) {
    const auto first = static_cast<std::int32_t>(tree.positions.size());
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.03, 0, 0), Vec3(0.03, 0.03, 0), Vec3(0, 0.03, 0)}) {
        tree.positions.emplace_back(place + corner);
        tree.normals.emplace_back(Vec3::UnitZ());
    }
    tree.faces.push_back({first, first + 1, first + 2, first + 3});
    tree.uvs.push_back({Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)});
    tree.materials.push_back(1);
}

TEST(TreeBreak, LeavesGoWithWhatTheyHangOn) {
    test::TestTree tree = test::tube_tree(bent_tube());
    const std::size_t bark_faces = tree.faces.size();
    add_leaf(tree, {0.12, 0.3, 0.03});
    add_leaf(tree, {0.3, 1.7, 0.2});
    add_leaf(tree, {0.33, 1.72, 0.2});  // hangs on the leaf beside it as nearly as on the branch
    add_leaf(tree, {0.2, 1.0, 0.16});   // in front of the picked point: no branch
    const Mesh mesh = test::as_mesh(tree, false);
    const TreeBreak broken = break_tree(mesh, {0.21, 1.01, 0.16}, small_break());
    EXPECT_THAT(test::faces_taken_over(mesh, broken.tree), Contains(bark_faces));
    EXPECT_THAT(test::faces_taken_over(mesh, broken.piece), Contains(bark_faces + 1));
    EXPECT_THAT(test::faces_taken_over(mesh, broken.piece), Contains(bark_faces + 2));
}

TEST(TreeBreak, SameBitsEachTimeAndOtherOnesForAnotherSeed) {
    FractureParameters p = small_break();
    const Mesh mesh = bent_tree(false);
    const TreeBreak a = break_tree(mesh, kOnBentTree, p), b = break_tree(mesh, kOnBentTree, p);
    EXPECT_EQ(a.tree.positions, b.tree.positions);
    EXPECT_EQ(a.piece.corners, b.piece.corners);
    p.seed = 2;
    EXPECT_NE(a.tree.positions, break_tree(mesh, kOnBentTree, p).tree.positions);
}

TEST(TreeBreak, RandomBreaksInRandomBranchesAreClosed) {
    std::mt19937 random(11);
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    for (int i = 0; i < 12; ++i) {
        test::Tube tube;
        const Vec3 lean(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const double a = uniform(0.05, 0.12), b = uniform(0.05, 0.12), bend = uniform(0, 0.6);
        tube.centre = [=](double t) { return Vec3(lean * t + Vec3(bend * t * t, 3 * t, -bend * t * t)); };
        tube.half_axes = [=](double t) { return Vec2(a * (1 - 0.3 * t), b * (1 - 0.3 * t)); };
        tube.sides = static_cast<int>(uniform(5, 40));
        tube.rings = static_cast<int>(uniform(4, 60));
        const Mesh mesh = test::as_mesh(test::tube_tree(tube), i % 2 == 0);
        FractureParameters p = small_break();
        p.seed = i;
        p.fracture.tilt_deg = uniform(0, 50);
        p.bundles.amplitude = {uniform(0, 1), uniform(0, 1.5)};
        p.thorns.heartwood_length = 1;
        p.thorns.heartwood_probability = uniform(0, 0.3);
        const TreeBreak broken = break_tree(mesh, tube.centre(uniform(0.4, 0.6)) + Vec3(0.5 * a, 0, 0), p);
        EXPECT_EQ(test::bad_edges(broken.tree), 0U) << i;
        EXPECT_EQ(test::bad_edges(broken.piece), 0U) << i;
    }
}

TEST(TreeBreak, BadInputIsToldWithTheRemedy) {
    const FractureParameters p = small_break();
    const Mesh mesh = bent_tree(false);
    const auto message = [&](const Mesh& tree, const Vec3& at, const FractureParameters& parameters) {
        return message_of([&] { break_tree(tree, at, parameters); });
    };
    EXPECT_THAT(message(mesh, {2, 2, 2}, p), HasSubstr("off the tree"));
    EXPECT_THAT(message(mesh, {2, 2, 2}, p), HasSubstr("--at"));
    EXPECT_THAT(message(mesh, {meshfile::kAbsent, 0, 0}, p), HasSubstr("not finite"));
    EXPECT_THAT(message(mesh, {0.1, 0.1, 0}, p), HasSubstr("ends"));
    EXPECT_THAT(message(forked_tree(), {0.1, 2.2, 0}, p), HasSubstr("forks"));
    EXPECT_THAT(message(forked_tree(), {0.1, 2.2, 0}, p), HasSubstr("pick a point"));

    Mesh open = mesh;  // without the faces about half way up
    std::vector<bool> keep(open.face_count(), true);
    for (std::size_t f = 0; f < keep.size(); ++f) {
        const Vec3& v = open.positions[static_cast<std::size_t>(open.corners[open.face_starts[f]])];
        if (std::abs(v.y() - 1.1) < 0.1 && v.x() > 0.1) keep[f] = false;
    }
    open = meshfile::part_of(open, keep, {}).mesh;
    EXPECT_THAT(message(open, kOnBentTree, p), HasSubstr("not closed"));

    Mesh inside_out = mesh;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        std::reverse(inside_out.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_starts[f]),
                     inside_out.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_starts[f + 1]));
    EXPECT_THAT(message(inside_out, kOnBentTree, p), HasSubstr("normals outwards"));

    FractureParameters cut = p;
    cut.fracture.end = EndKind::Cut;
    EXPECT_THAT(message(mesh, kOnBentTree, cut), HasSubstr("break.end"));
    TreeBreakOptions options;
    options.unit_m = 100;
    EXPECT_THAT(message_of([&] { break_tree(mesh, kOnBentTree, p, options); }), HasSubstr("unit"));
}

TEST(TreeBreak, ARingThatHoldsTogetherCannotFallApart) {
    // A torus: cutting it once parts nothing.
    test::TestTree torus;
    constexpr int kAround = 40, kSides = 12;
    for (int i = 0; i < kAround; ++i)
        for (int k = 0; k < kSides; ++k) {
            const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * k / kSides;
            const double r = 1 + 0.1 * std::cos(b);
            torus.positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.1 * std::sin(b));
        }
    for (int i = 0; i < kAround; ++i)
        for (int k = 0; k < kSides; ++k) {
            const auto at = [&](int n, int m) { return (n % kAround) * kSides + m % kSides; };
            torus.faces.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
            torus.uvs.emplace_back(4, Vec2::Zero());
            torus.materials.push_back(0);
        }
    test::set_normals(torus);
    const Mesh mesh = test::as_mesh(torus, false);
    ASSERT_GT(test::volume(mesh), 0);
    EXPECT_THAT(message_of([&] {
                    break_tree(mesh, {1.1, 0, 0}, small_break());
                }),
                HasSubstr("hold together"));
}

}  // namespace
}  // namespace windfall::fracture
