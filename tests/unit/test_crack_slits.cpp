// Cracks in the ends of a broken branch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fracture/broken_branch.h"
#include "fracture/open_cracks.h"
#include "support/branch_checks.h"
#include "support/random_branch.h"
#include "support/random_cracks.h"

namespace windfall::fracture {
namespace {

/// Bundles and thorns, or a flat break without anything.
FractureParameters break_with_cracks(bool flat) {
    FractureParameters p;
    p.branch.rings = 40;
    p.branch.sectors = 120;
    p.branch.layers = 4;
    p.output.piece = PiecePlace::Above;
    p.roughness.phloem = p.roughness.sapwood = p.roughness.heartwood = 0;
    if (!flat) {
        p.bundles.radial = {0.5, 0.2, 0.07};
        p.bundles.angular = {0.9, 0.3, 0.1};
        p.bundles.amplitude = {0.6, 0.5, 0.2};
        p.bundles.slope = {0.3, 0.4, 0.4};
        p.tissue.heartwood = 0;  // thorns all over the wood
        p.thorns.sapwood_length = 1;
        p.thorns.sapwood_probability = 0.1;
    }
    p.cracks.large = {4, 0, 0.5, 0.3, 0.05};
    p.cracks.tangential = {3, 0, 0.5, 0.3, 0.02};
    return p;
}

BreakEnds ends_of(const FractureParameters& p) {
    BreakEnds ends;
    BreakWorkspace workspace;
    make_break_ends(p, ends, workspace);
    return ends;
}

/// Places in plan on thorns, if there are any.
std::vector<Vector2f> places_on_thorns(const BranchMesh& mesh, std::size_t count) {
    std::vector<Vector2f> thorns, result;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.thorn[v] > 0 && mesh.thorn[v] < 0.6F) thorns.emplace_back(mesh.positions[v].head<2>());
    for (std::size_t k = 0; k < count && !thorns.empty(); ++k)
        result.emplace_back(thorns[k * 7919 % thorns.size()] + Vector2f(0.0011F, -0.0007F));
    return result;
}

TEST(CrackSlits, ThornsStayInTheirHoles) {
    FractureParameters p = break_with_cracks(false);
    p.cracks.large.width = 0.1;
    for (p.seed = 1; p.seed <= 3; ++p.seed) {
        BreakEnds ends;
        BreakWorkspace workspace;
        make_unplaced(p, ends, workspace);
        ASSERT_GT(ends.stub_thorns, 10);
        for (const BranchMesh* mesh : {&ends.stub, &ends.piece})
            for (const Vector2f& at : places_on_thorns(*mesh, 60))
                ASSERT_LT(test::overlap_along_z(ends.stub, ends.piece, at.x(), at.y()), 1e-5);
    }
}

TEST(CrackSlits, RandomBreaksStayClosedAndFitWithoutOverlap) {
    BreakEnds ends;
    BreakWorkspace workspace;
    int refused = 0;
    for (std::uint32_t number = 0; number < 60; ++number) {
        FractureParameters p = test::random_branch(number, 24, 60);
        test::add_random_cracks(number, p);
        try {
            make_unplaced(p, ends, workspace);
        } catch (const InputError&) {
            ++refused;  // a break too high for its taper or bend
            continue;
        }
        compute_normals(ends.stub);
        compute_normals(ends.piece);
        ASSERT_EQ(test::complaint_about(ends.stub), "") << "recipe " << number;
        ASSERT_EQ(test::complaint_about(ends.piece), "") << "recipe " << number;
        std::mt19937 generator(number);
        for (int k = 0; k < 6; ++k) {
            const double radius = 0.95 * std::sqrt(generator() / 4294967296.0);
            const double angle = 6.28 * generator() / 4294967296.0;
            ASSERT_LT(test::overlap_along_z(ends.stub, ends.piece, radius * std::cos(angle),
                                            radius * std::sin(angle)),
                      1e-5)
                << "recipe " << number;
        }
    }
    EXPECT_LT(refused, 30);
}

TEST(CrackSlits, BothEndsMoveAlikeAndKeepTheirRim) {
    const FractureParameters p = break_with_cracks(false);
    const BreakEnds before = ends_of(p);
    BreakEnds ends = before;
    const CrackCount count = open_cracks(ends, p);
    EXPECT_GT(count.opened, 3);
    EXPECT_GT(ends.surface_vertices, before.surface_vertices);
    double moved = 0;
    for (std::size_t v = 0; v < static_cast<std::size_t>(ends.surface_vertices); ++v) {
        const Vector3f &a = ends.stub.positions[v], &b = ends.piece.positions[v];
        ASSERT_EQ(a.x(), b.x());
        ASSERT_EQ(a.y(), b.y());
        ASSERT_LE(a.z(), b.z());
        if (v >= static_cast<std::size_t>(before.surface_vertices)) continue;
        ASSERT_EQ(a.z(), before.stub.positions[v].z());
        moved = std::max<double>(moved, (a - before.stub.positions[v]).norm());
    }
    EXPECT_GT(moved, 0.01);
    EXPECT_LT(moved, 0.15);
    ASSERT_EQ(ends.rim.size(), before.rim.size());
    for (std::size_t i = 0; i < ends.rim.size(); ++i) {
        const auto v = static_cast<std::size_t>(ends.rim[i].vertex);
        EXPECT_EQ(ends.rim[i].vertex, before.rim[i].vertex);
        EXPECT_EQ(ends.stub.positions[v], before.stub.positions[v]);
    }
}

TEST(CrackSlits, CellsKnowTheVerticesOfTheirSide) {
    const FractureParameters p = break_with_cracks(false);
    BreakEnds ends = ends_of(p);
    open_cracks(ends, p);
    // Each cell's quadrilateral is a face of the surface, of its corners as they are now.
    std::vector<std::array<std::int32_t, 4>> faces;
    for (std::size_t f = 0; f < ends.surface_faces; ++f) faces.push_back(ends.stub.faces[f]);
    std::sort(faces.begin(), faces.end());
    for (int r = 1; r < ends.cells.rings; ++r)
        for (int s = 0; s < ends.cells.sectors; ++s)
            ASSERT_TRUE(std::binary_search(faces.begin(), faces.end(), ends.cells.of(r, s)));
}

TEST(CrackSlits, CracksAreAsDeepAsAskedInBothEnds) {
    FractureParameters p = break_with_cracks(true);
    p.cracks.irregularity = 0;
    p.cracks.large = {1, 0, 0.5, 0.3, 0.05};
    p.cracks.tangential = {};
    BreakEnds ends = ends_of(p);
    open_cracks(ends, p);
    const CrackSet set = draw_cracks(p);
    const double depth = set.cracks.at(0).depth;
    double deepest = 0, highest = 0;
    for (std::size_t f = 0; f < ends.stub.face_count(); ++f) {
        if (ends.stub.parts[f] != Part::Crack) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(ends.stub.faces[f][k]);
            deepest = std::min<double>(deepest, ends.stub.positions[v].z());
            highest = std::max<double>(highest, ends.piece.positions[v].z());
        }
    }
    EXPECT_NEAR(deepest, -depth, 0.16 * depth);
    EXPECT_NEAR(highest, -deepest, 1e-6);
}

TEST(CrackSlits, SlitsOpenAsWideAsAsked) {
    FractureParameters p = break_with_cracks(true);
    p.cracks.irregularity = 0;
    p.cracks.large = {1, 0, 0.5, 0.3, 0.05};
    p.cracks.tangential = {};
    BreakEnds ends = ends_of(p);
    open_cracks(ends, p);
    const Crack crack = draw_cracks(p).cracks.at(0);
    double widest = 0;
    for (int r = 1; r < ends.cells.rings; ++r)
        for (int s = 0; s < ends.cells.sectors; ++s) {
            const int before = (s + ends.cells.sectors - 1) % ends.cells.sectors;
            const Vector3f& left = ends.stub.positions[static_cast<std::size_t>(ends.cells.of(r, s)[0])];
            const Vector3f& right =
                ends.stub.positions[static_cast<std::size_t>(ends.cells.of(r, before)[3])];
            widest = std::max<double>(
                widest, (right.x() * left.y() - right.y() * left.x()) / left.head<2>().squaredNorm());
        }
    EXPECT_NEAR(widest, 2 * crack.half_width, 0.1 * crack.half_width);
}

TEST(CrackSlits, TheCheckStaysInTheWood) {
    FractureParameters p = break_with_cracks(false);
    p.cracks = {};
    p.cracks.check = true;
    p.species.name = SpeciesName::Ailanthus;
    BreakEnds ends = ends_of(p);
    EXPECT_EQ(open_cracks(ends, p).opened, 1);
    double outermost = 0;
    for (std::size_t f = 0; f < ends.stub.face_count(); ++f)
        for (std::size_t k = 0; k < 3 && ends.stub.parts[f] == Part::Crack; ++k) {
            const Vector3f& place = ends.stub.positions[static_cast<std::size_t>(ends.stub.faces[f][k])];
            outermost = std::max<double>(outermost, std::hypot(place.x(), place.y()));
        }
    EXPECT_GT(outermost, 0.8);
    EXPECT_LT(outermost, 1 - p.tissue.phloem + 0.01);
}

TEST(CrackSlits, SameSeedSameBits) {
    const FractureParameters p = break_with_cracks(false);
    BreakEnds a = ends_of(p), b = ends_of(p);
    open_cracks(a, p);
    open_cracks(b, p);
    EXPECT_EQ(a.stub.positions, b.stub.positions);
    EXPECT_EQ(a.piece.faces, b.piece.faces);
}

}  // namespace
}  // namespace windfall::fracture
