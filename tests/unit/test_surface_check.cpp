#include "geometry/surface_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "support/message_of.h"
#include "support/test_surfaces.h"

namespace windfall::geometry {
namespace {

using test::sphere_mesh;
using Kind = SurfaceDefectKind;

std::vector<Kind> kinds_of(const std::vector<SurfaceDefect>& defects) {
    std::vector<Kind> kinds;
    for (const auto& defect : defects) kinds.push_back(defect.kind);
    return kinds;
}

/// The face of a sphere mesh nearest to a direction.
std::size_t face_towards(const SurfaceMesh& mesh, const Vec3& direction) {
    const auto height = [&](const Face& face) {
        return (mesh.positions[face[0]] + mesh.positions[face[1]] + mesh.positions[face[2]]).dot(direction);
    };
    return std::max_element(mesh.faces.begin(), mesh.faces.end(),
                            [&](const Face& a, const Face& b) { return height(a) < height(b); }) -
           mesh.faces.begin();
}

void remove_face(SurfaceMesh& mesh, std::size_t f) {
    mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(f));
    mesh.corner_uvs.erase(mesh.corner_uvs.begin() + static_cast<std::ptrdiff_t>(f));
}

void append(SurfaceMesh& mesh, const SurfaceMesh& other, const Vec3& shift) {
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    for (const Vec3& p : other.positions) mesh.positions.emplace_back(p + shift);
    for (Face face : other.faces) {
        for (int c = 0; c < corner_count(face); ++c) face[c] += first;
        mesh.faces.push_back(face);
    }
    mesh.corner_uvs.clear();
}

SurfaceMesh torus_mesh(double radius_m, double thin_m, double thick_m) {
    constexpr int kAround = 48, kAcross = 20;
    SurfaceMesh mesh;
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j) {
            const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * j / kAcross;
            const double tube = 0.5 * (thin_m + thick_m) - 0.5 * (thick_m - thin_m) * std::cos(a);
            const double rho = radius_m + tube * std::cos(b);
            mesh.positions.emplace_back(rho * std::cos(a), rho * std::sin(a), tube * std::sin(b));
        }
    const auto v = [&](int i, int j) { return i % kAround * kAcross + j % kAcross; };
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAcross; ++j)
            mesh.faces.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)});
    return mesh;
}

TEST(SurfaceCheck, SoundMeshesHaveNoDefects) {
    for (const auto& [name, mesh] : test::fruit_meshes()) {
        EXPECT_THAT(surface_defects(mesh), testing::IsEmpty()) << name;
        EXPECT_THAT(surface_defects(test::split_vertices(mesh)), testing::IsEmpty()) << name << " split";
        EXPECT_NO_THROW(require_closed(mesh, name));
    }
}

TEST(SurfaceCheck, CollapsedSidesOfQuadrilateralsAreNoDefect) {
    SurfaceMesh mesh = sphere_mesh();
    for (Face& face : mesh.faces)
        if (face[3] == kNoVertex) face[3] = face[2];
    EXPECT_THAT(surface_defects(mesh), testing::IsEmpty());
}

TEST(SurfaceCheck, FindsAHoleAtItsPlace) {
    SurfaceMesh mesh = sphere_mesh();
    const Vec3 place = Vec3(0.3, -0.5, 0.7).normalized();
    remove_face(mesh, face_towards(mesh, place));
    remove_face(mesh, face_towards(mesh, Vec3(-1, 0.02, 0.01)));
    const auto defects = surface_defects(mesh);
    ASSERT_THAT(kinds_of(defects), testing::ElementsAre(Kind::Hole, Kind::Hole));
    const auto near = [&](const Vec3& x) {
        return std::any_of(defects.begin(), defects.end(),
                           [&](const auto& d) { return (d.place_m - x).norm() < 0.002; });
    };
    EXPECT_TRUE(near(0.04 * place));
    EXPECT_TRUE(near({-0.04, 0, 0}));
    EXPECT_EQ(defects[0].faces.size(), 4U);
    EXPECT_THAT(defects[0].text, testing::HasSubstr("a hole of 4 edges around ("));
}

TEST(SurfaceCheck, FindsAFin) {
    SurfaceMesh mesh = sphere_mesh();
    const std::size_t f = face_towards(mesh, Vec3(0, 1, 0.1));
    mesh.positions.emplace_back(0, 0.06, 0);
    mesh.faces.push_back({mesh.faces[f][0], mesh.faces[f][1],
                          static_cast<std::int32_t>(mesh.positions.size()) - 1, kNoVertex});
    mesh.corner_uvs.clear();
    const auto defects = surface_defects(mesh);
    const auto fin =
        std::find_if(defects.begin(), defects.end(), [](auto& d) { return d.kind == Kind::Fin; });
    ASSERT_NE(fin, defects.end());
    EXPECT_LT((fin->place_m - mesh.positions[mesh.faces[f][0]]).norm(), 0.002);
    EXPECT_THAT(fin->faces, testing::Contains(static_cast<std::int32_t>(mesh.faces.size()) - 1));
    EXPECT_THAT(kinds_of(defects), testing::Contains(Kind::Hole)) << "the fin's own rim is open";
}

TEST(SurfaceCheck, FindsFlippedFaces) {
    SurfaceMesh mesh = sphere_mesh();
    const auto f = static_cast<std::int32_t>(face_towards(mesh, Vec3(1, 1, -0.5)));
    std::swap(mesh.faces[f][1], mesh.faces[f][3]);
    std::swap(mesh.faces[f + 1][1], mesh.faces[f + 1][3]);
    const auto defects = surface_defects(mesh);
    ASSERT_THAT(kinds_of(defects), testing::ElementsAre(Kind::FlippedFace));
    EXPECT_LT((defects[0].place_m - 0.04 * Vec3(1, 1, -0.5).normalized()).norm(), 0.003);
    EXPECT_THAT(defects[0].faces, testing::ElementsAre(f, f + 1));
}

TEST(SurfaceCheck, FindsABodyThatIsInsideOut) {
    SurfaceMesh mesh = test::banana_mesh();
    for (Face& face : mesh.faces) {
        if (corner_count(face) == 4)
            std::swap(face[1], face[3]);
        else
            std::swap(face[1], face[2]);
    }
    const auto defects = surface_defects(mesh);
    ASSERT_THAT(kinds_of(defects), testing::ElementsAre(Kind::InsideOut));
    EXPECT_EQ(defects[0].faces.size(), mesh.faces.size());
}

TEST(SurfaceCheck, FindsBowTieAndSeveralBodies) {
    SurfaceMesh mesh = sphere_mesh(24, 16);
    append(mesh, sphere_mesh(24, 16), {0, 0, 0.08});
    const auto touching = surface_defects(mesh);
    ASSERT_THAT(kinds_of(touching), testing::ElementsAre(Kind::BowTie));
    EXPECT_LT((touching[0].place_m - Vec3(0, 0, 0.04)).norm(), 1e-6);
    EXPECT_EQ(touching[0].faces.size(), 48U);

    SurfaceMesh apart = sphere_mesh(24, 16);
    append(apart, sphere_mesh(24, 16, 0.01), {0, 0.1, 0});
    const auto two = surface_defects(apart);
    ASSERT_THAT(kinds_of(two), testing::ElementsAre(Kind::SeveralBodies));
    EXPECT_LT((two[0].place_m - Vec3(0, 0.1, 0)).norm(), 1e-6);
    EXPECT_EQ(two[0].faces.size(), 24U * 16U);
}

TEST(SurfaceCheck, FindsAHandle) {
    const auto defects = surface_defects(torus_mesh(0.04, 0.003, 0.012));
    ASSERT_THAT(kinds_of(defects), testing::ElementsAre(Kind::Handle));
    // The loop around the thin side of the ring is the shortest.
    EXPECT_LT((defects[0].place_m - Vec3(0.04, 0, 0)).norm(), 0.01);
    EXPECT_THAT(defects[0].text, testing::HasSubstr("1 way through"));
}

TEST(SurfaceCheck, FindsSelfIntersections) {
    // A rod bent by more than a full turn meets itself end to end.
    SurfaceMesh rod = test::bent_rod(0.17, 0.017, 6.6, 48, 96);
    const auto closed = surface_defects(rod);
    ASSERT_THAT(kinds_of(closed), testing::Each(Kind::SelfIntersection));
    ASSERT_FALSE(closed.empty());
    const double far = 2 * 0.17 / 6.6;  // the ends meet opposite the middle
    for (const auto& defect : closed) EXPECT_LT((defect.place_m - Vec3(far, 0, 0)).norm(), 0.02);

    SurfaceMesh pushed = sphere_mesh();
    pushed.positions[face_towards(pushed, Vec3(1, 0.02, 0))] = {0, 0, 0};
    const std::size_t v = 40 * 96;
    const Vec3 moved = pushed.positions[v];
    pushed.positions[v] = -1.2 * moved;  // through the other side
    EXPECT_THAT(kinds_of(surface_defects(pushed)), testing::Contains(Kind::SelfIntersection));
}

TEST(SurfaceCheck, FindsFoldsBetweenFacesThatShareAVertex) {
    SurfaceMesh mesh = sphere_mesh(24, 16);
    // A vertex pushed two faces along the surface: its fan lies over its neighbours.
    const std::size_t v = 1 + 7 * 24 + 5;
    mesh.positions[v] = 1.001 * mesh.positions[v + 2] + 0.001 * Vec3(0.1, 0.2, 0.3);
    EXPECT_THAT(kinds_of(surface_defects(mesh)), testing::Contains(Kind::SelfIntersection));
}

TEST(SurfaceCheck, FindsDegenerateFaces) {
    SurfaceMesh mesh = sphere_mesh(24, 16);
    const std::size_t v = 1 + 7 * 24 + 5;
    // On the edge between its neighbours below and above: quadrilaterals stay sound, so cut two of them.
    const Vec3 a = mesh.positions[v - 1], b = mesh.positions[v + 1];
    const auto next = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.emplace_back((a + b) / 2);
    mesh.faces.push_back(
        {static_cast<std::int32_t>(v - 1), next, static_cast<std::int32_t>(v + 1), kNoVertex});
    mesh.corner_uvs.clear();
    const auto defects = surface_defects(mesh);
    ASSERT_FALSE(defects.empty());
    EXPECT_EQ(defects[0].kind, Kind::Degenerate);
    EXPECT_LT((defects[0].place_m - (a + b) / 2).norm(), 1e-6);
}

TEST(SurfaceCheck, RequireClosedNamesTheFileAndTheFirstFew) {
    SurfaceMesh mesh = sphere_mesh();
    for (int k = 0; k < 8; ++k)
        remove_face(mesh, face_towards(mesh, Vec3(std::cos(0.7 * k), std::sin(0.7 * k), 0.01)));
    const std::string text = message_of([&] { require_closed(mesh, "plum.obj"); });
    EXPECT_THAT(text, testing::HasSubstr("plum.obj"));
    EXPECT_THAT(text, testing::HasSubstr("a hole of 4 edges around ("));
    EXPECT_THAT(text, testing::HasSubstr("and 3 more"));
    EXPECT_THAT(message_of([] { require_closed({}, "empty.ply"); }), testing::HasSubstr("no faces"));
}

TEST(SurfaceCheck, RefusesVerticesThatAreNotThere) {
    SurfaceMesh mesh = sphere_mesh(24, 16);
    mesh.faces[3][1] = 100000;
    EXPECT_THROW(surface_defects(mesh), InputError);
    mesh = sphere_mesh(24, 16);
    mesh.positions[3].x() = std::nan("");
    EXPECT_THROW(surface_defects(mesh), InputError);
}

}  // namespace
}  // namespace windfall::geometry
