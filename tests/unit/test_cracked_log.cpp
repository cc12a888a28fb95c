#include "fracture/cracked_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fracture/crack_shape.h"
#include "support/branch_checks.h"
#include "support/random_branch.h"
#include "support/random_cracks.h"

namespace windfall::fracture {
namespace {

constexpr double kPi = std::numbers::pi;

/// A log with cracks of all kinds.
FractureParameters oak_log(std::int64_t rings, std::int64_t sectors) {
    FractureParameters p;
    p.branch.rings = rings;
    p.branch.sectors = sectors;
    p.branch.layers = 20;
    p.branch.length = 1.3;
    p.species.shrinkage_radial = 0.04;
    p.species.shrinkage_tangential = 0.106;
    p.cracks.check = true;
    p.cracks.large = {5, 0, 0.5, 0.35, 0.022};
    p.cracks.medium = {10, 0, 0.3, 0.2, 0.009};
    p.cracks.small = {12, 0, 0.15, 0.1, 0.005};
    p.cracks.tangential = {3, 0, 0.4, 0.15, 0.008};
    return p;
}

TEST(CrackedSection, ClosesCracksAsTheLastResort) {
    const FractureParameters p = oak_log(40, 120);
    const CrackGrid grid = crack_grid(p);
    CrackedSection section(p, grid, draw_cracks(p, crack_room(grid)), 1);
    const CrackCount before = section.count();
    std::vector<CrackedSection::Cell> all;
    for (int r = 0; r < grid.rings; ++r)
        for (int s = 0; s < grid.sectors; ++s) all.push_back({r, s});
    EXPECT_TRUE(section.close_around(all));
    EXPECT_EQ(section.count().opened, 0);
    EXPECT_EQ(section.count().narrowed, 0);
    EXPECT_EQ(section.count().dropped, before.dropped + before.opened);
    for (const CrackedSection::Cell& cell : all) {
        const CrackShift shift = section.shift(cell.ring, cell.sector, 0, CrackSide::Left);
        ASSERT_TRUE(shift.angle == 0 && shift.radius == 0);
    }
    EXPECT_FALSE(section.close_around(all)) << "there is none left";
}

TEST(CrackedLog, RandomLogsAreClosedManifoldAndOriented) {
    for (std::uint32_t number = 0; number < 80; ++number) {
        FractureParameters p = test::random_branch(number, 30, 70);
        test::add_random_cracks(number, p);
        CrackedLog log = make_cracked_log(p);
        compute_normals(log.mesh);
        ASSERT_EQ(test::complaint_about(log.mesh), "") << "recipe " << number;
        ASSERT_GT(test::volume(log.mesh), 0) << "recipe " << number;
        EXPECT_EQ(log.cracks.opened + log.cracks.dropped, log.cracks.asked);
    }
}

TEST(CrackedLog, CracksTakeAsMuchRoomAsTheyAreWideAndDeep) {
    FractureParameters p = oak_log(90, 240);
    p.cracks.irregularity = 0;
    const CrackShape shape(p);
    const CrackedLog log = make_cracked_log(p);
    p.cracks = {};
    p.cracks.irregularity = 0;
    const double lost = test::volume(make_cracked_log(p).mesh) - test::volume(log.mesh);
    // The openings fall to 0 at the bottoms: half of opening times depth, over the length.
    double room = 0;
    for (const LatticeCrack& c : shape.section().cracks())
        for (int along = c.begin; along <= c.last_node(); ++along) {
            const bool at_end = along == c.begin || along == c.last_node();
            const double step = c.crack.radial() ? 1.0 / 90 : 2 * kPi / 240;
            const double radius = c.crack.radial() ? along / 90.0 : c.line / 90.0;
            room += (at_end ? 0.5 : 1) * step * radius * c.opening[c.entry(along)] * c.depth[c.entry(along)];
        }
    EXPECT_GT(room, 0.05);
    EXPECT_NEAR(lost, room, 0.05 * room);
}

TEST(CrackedLog, HasItsPartsWhereTheyBelong) {
    const FractureParameters p = oak_log(40, 120);
    CrackedLog log = make_cracked_log(p);
    compute_normals(log.mesh);
    std::array<int, kPartCount> count{};
    double deepest = 0;
    for (std::size_t f = 0; f < log.mesh.face_count(); ++f) {
        const geometry::Face& face = log.mesh.faces[f];
        const Part part = log.mesh.parts[f];
        ++count[static_cast<std::size_t>(part)];
        const Vector3f& normal = log.mesh.face_normals[f];
        for (int k = 0; k < geometry::corner_count(face); ++k) {
            const auto v = static_cast<std::size_t>(face[static_cast<std::size_t>(k)]);
            const Vector3f& place = log.mesh.positions[v];
            const Vector2f& uv = log.mesh.corner_uvs[f][static_cast<std::size_t>(k)];
            EXPECT_EQ(log.mesh.height[v], place.z());
            EXPECT_EQ(log.mesh.thorn[v], 0);
            if (part == Part::EndGrain || part == Part::InnerBark) {
                const bool upper = place.z() > -0.65F;
                EXPECT_GT((upper ? 1 : -1) * normal.z(), 0.5F);
                EXPECT_NEAR(place.z(), upper ? 0 : -1.3, 0.01);
                EXPECT_NEAR(uv.x(), 0.5 * place.x() + 0.5, 1e-6);
                EXPECT_NEAR(uv.y(), 0.5 * place.y() + 0.5, 1e-6);
                if (part == Part::EndGrain) {
                    EXPECT_LE(static_cast<int>(log.mesh.tissue[v]), static_cast<int>(Tissue::Sapwood));
                }
            } else if (part == Part::Bark) {
                EXPECT_EQ(log.mesh.tissue[v], Tissue::Bark);
                EXPECT_NEAR(normal.z(), 0, 0.2);
                EXPECT_GE(uv.x(), 0);
                EXPECT_LE(uv.x(), 1);
                EXPECT_NEAR(uv.y(), place.z() / (2 * kPi), 1e-6);
            } else {
                EXPECT_NEAR(uv.y(), place.z() / (2 * kPi), 1e-6);
                deepest = std::min<double>(deepest, place.z());
            }
        }
    }
    for (const Part part : {Part::Bark, Part::EndGrain, Part::InnerBark, Part::Crack})
        EXPECT_GT(count[static_cast<std::size_t>(part)], 0);
    EXPECT_EQ(count[static_cast<std::size_t>(Part::Fibres)], 0);
    EXPECT_NEAR(deepest, -p.cracks.check_depth, 0.15 * p.cracks.check_depth);  // its bottom is ragged
}

TEST(CrackedLog, SeamOfTheBarkIsInTheTextureAlone) {
    FractureParameters p;
    p.branch.rings = 8;
    p.branch.sectors = 24;
    p.branch.layers = 5;
    const CrackedLog log = make_cracked_log(p);
    for (std::size_t f = 0; f < log.mesh.face_count(); ++f) {
        if (log.mesh.parts[f] != Part::Bark) continue;
        const auto& uv = log.mesh.corner_uvs[f];
        EXPECT_NEAR(uv[1].x() - uv[0].x(), 1.0 / 24, 1e-6);
        EXPECT_NEAR(uv[2].x() - uv[3].x(), 1.0 / 24, 1e-6);
    }
}

TEST(CrackedLog, WithoutCracksItIsACylinder) {
    FractureParameters p = oak_log(20, 200);
    p.cracks = {};
    p.cracks.irregularity = 0;
    const CrackedLog log = make_cracked_log(p);
    EXPECT_NEAR(test::volume(log.mesh), 1.3 * kPi, 0.003);
    EXPECT_EQ(std::count(log.mesh.parts.begin(), log.mesh.parts.end(), Part::Crack), 0);
}

TEST(CrackedLog, DeepCracksStayInTheLog) {
    FractureParameters p = oak_log(30, 90);
    p.cracks.check_depth = 20;
    p.cracks.large.depth = 20;
    CrackedLog log = make_cracked_log(p);
    compute_normals(log.mesh);
    EXPECT_EQ(test::complaint_about(log.mesh), "");
    double deepest = 0;
    for (std::size_t f = 0; f < log.mesh.face_count(); ++f)
        for (std::size_t k = 0; k < 3 && log.mesh.parts[f] == Part::Crack; ++k)
            deepest = std::min<double>(
                deepest, log.mesh.positions[static_cast<std::size_t>(log.mesh.faces[f][k])].z());
    EXPECT_NEAR(deepest, -0.9 * 1.3, 1e-5);
}

TEST(CrackedLog, SameSeedSameBitsAnotherSeedOtherCracks) {
    FractureParameters p = oak_log(30, 90);
    const CrackedLog a = make_cracked_log(p), b = make_cracked_log(p);
    EXPECT_EQ(a.mesh.positions, b.mesh.positions);
    EXPECT_EQ(a.mesh.faces, b.mesh.faces);
    EXPECT_EQ(a.mesh.bundle, b.mesh.bundle);
    p.seed = 2;
    EXPECT_NE(make_cracked_log(p).mesh.positions, a.mesh.positions);
}

TEST(CrackedLog, ASliderDeformsTheLogInsteadOfReplacingIt) {
    FractureParameters p = oak_log(60, 160);
    const CrackedLog before = make_cracked_log(p);
    p.cracks.small.width *= 1.1;
    p.cracks.check_relief *= 1.05;
    const CrackedLog after = make_cracked_log(p);
    ASSERT_EQ(before.mesh.faces, after.mesh.faces);
    float farthest = 0;
    for (std::size_t v = 0; v < before.mesh.vertex_count(); ++v)
        farthest = std::max(farthest, (before.mesh.positions[v] - after.mesh.positions[v]).norm());
    EXPECT_GT(farthest, 1e-4F);
    EXPECT_LT(farthest, 0.02F);
}

}  // namespace
}  // namespace windfall::fracture
