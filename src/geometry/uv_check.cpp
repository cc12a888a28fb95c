#include "geometry/uv_check.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "geometry/surface_check_edges.h"
#include "geometry/uv_raster.h"

namespace windfall::geometry {

namespace {

constexpr int kOverlapRaster = 512;
/// Faces that each fill the square, as some programs have it from the start, would take minutes to draw.
constexpr double kMostCover = 4;
/// Texel centres nearer than this (as a weight) to a triangle's rim belong to its neighbour as well.
constexpr double kRim = 1e-4;
/// Rounding beyond [0, 1] that costs nothing: a small part of a texel.
constexpr double kOutsideAllowed = 1e-4;
constexpr double kAreaAllowedOnLines = 0.01;
constexpr double kSmallestUvArea = 1e-12;
constexpr std::size_t kUvDefectsNamed = 5;

std::vector<std::int32_t> ascending(std::vector<std::int32_t> faces) {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

std::vector<UvDefect> missing_uvs(const SurfaceMesh& mesh) {
    if (mesh.corner_uvs.size() != mesh.faces.size())
        return {
            {UvDefectKind::Missing, Vec2::Zero(), {}, "there are no texture coordinates: unwrap the mesh"}};
    std::vector<std::int32_t> faces;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (int c = 0; c < corner_count(mesh.faces[f]); ++c)
            if (!mesh.corner_uvs[f][c].allFinite()) faces.push_back(static_cast<std::int32_t>(f));
    if (faces.empty()) return {};
    faces = ascending(faces);
    return {{UvDefectKind::Missing, Vec2::Zero(), faces,
             fmt::format("{} face{} no texture coordinates, the first is face {}: unwrap the whole mesh",
                         faces.size(), faces.size() == 1 ? " has" : "s have", faces[0])}};
}

void find_outside(const SurfaceMesh& mesh, std::vector<UvDefect>& defects) {
    UvDefect defect{UvDefectKind::OutOfRange, Vec2::Zero(), {}, {}};
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (int c = 0; c < corner_count(mesh.faces[f]); ++c) {
            const Vec2& uv = mesh.corner_uvs[f][c];
            if (uv.minCoeff() >= -kOutsideAllowed && uv.maxCoeff() <= 1 + kOutsideAllowed) continue;
            if (defect.faces.empty()) defect.place = uv;
            defect.faces.push_back(static_cast<std::int32_t>(f));
        }
    if (defect.faces.empty()) return;
    defect.faces = ascending(defect.faces);
    defect.text = fmt::format(
        "{} face{} texture coordinates outside 0 .. 1, the first is face {} with ({:.4g}, {:.4g}): tiles "
        "(UDIM) and "
        "repeats are not supported, pack all charts into one square",
        defect.faces.size(), defect.faces.size() == 1 ? " has" : "s have", defect.faces[0], defect.place.x(),
        defect.place.y());
    defects.push_back(defect);
}

void find_without_area(const SurfaceMesh& mesh, const TriangleSurface& surface,
                       std::vector<UvDefect>& defects) {
    UvDefect defect{UvDefectKind::NoArea, Vec2::Zero(), {}, {}};
    double area = 0, area_on_lines = 0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& [a, b, c] = surface.triangles[t];
        const auto& p = surface.positions;
        const double here = (p[b] - p[a]).cross(p[c] - p[a]).norm();
        const auto uv = uvs_of(mesh, surface.origin[t]);
        const Vec2 along = uv[1] - uv[0], across = uv[2] - uv[0];
        area += here;
        if (std::abs(along.x() * across.y() - along.y() * across.x()) > kSmallestUvArea) continue;
        area_on_lines += here;
        if (defect.faces.empty()) defect.place = uv[0];
        defect.faces.push_back(surface.origin[t].face);
    }
    if (area_on_lines <= kAreaAllowedOnLines * area) return;
    defect.faces = ascending(defect.faces);
    defect.text = fmt::format(
        "{:.0f} % of the surface lies on points or lines of the texture, the first is face {} at ({:.4g}, "
        "{:.4g}): "
        "unwrap the mesh",
        100 * area_on_lines / area, defect.faces[0], defect.place.x(), defect.place.y());
    defects.push_back(defect);
}

/// How often all faces together would cover the square.
double cover_of(const SurfaceMesh& mesh, const TriangleSurface& surface) {
    double cover = 0;
    for (const TriangleOrigin& origin : surface.origin) {
        const auto uv = uvs_of(mesh, origin);
        const Vec2 along = uv[1] - uv[0], across = uv[2] - uv[0];
        cover += std::abs(along.x() * across.y() - along.y() * across.x()) / 2;
    }
    return cover;
}

bool share_a_vertex(const Triangle& a, const Triangle& b) {
    return std::any_of(a.begin(), a.end(),
                       [&](std::int32_t v) { return std::count(b.begin(), b.end(), v) > 0; });
}

void find_overlaps(const SurfaceMesh& mesh, const TriangleSurface& surface, std::vector<UvDefect>& defects) {
    constexpr int kSize = kOverlapRaster;
    const auto texel_of = [](int x, int y) { return y * kSize + x; };
    std::vector<std::int32_t> first(static_cast<std::size_t>(kSize) * kSize, -1), second = first;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for_each_texel(uvs_of(mesh, surface.origin[t]), kSize, [&](int x, int y, const Vec3& weights) {
            if (weights.minCoeff() < kRim) return;
            const int texel = texel_of(x, y);
            if (first[texel] < 0)
                first[texel] = static_cast<std::int32_t>(t);
            else if (second[texel] < 0 &&
                     !share_a_vertex(surface.triangles[first[texel]], surface.triangles[t]))
                second[texel] = static_cast<std::int32_t>(t);
        });
    GrowingSets sets(second.size());
    std::vector<std::int32_t> twice;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            if (second[texel_of(x, y)] < 0) continue;
            twice.push_back(texel_of(x, y));
            // Across corners too: the seam between two triangles is a row of texels in neither.
            for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
                if (x + dx < 0 || x + dx >= kSize || y + dy < 0) continue;
                if (second[texel_of(x + dx, y + dy)] >= 0)
                    sets.join(texel_of(x, y), texel_of(x + dx, y + dy));
            }
        }
    for (const auto& [set, texels] : sets.sets_of(twice)) {
        if (texels.size() <= kSmallestOverlap) continue;
        UvDefect defect{UvDefectKind::Overlap, Vec2::Zero(), {}, {}};
        for (const std::int32_t texel : texels) {
            const std::int32_t column = texel % kSize, row = texel / kSize;
            defect.place += Vec2((column + 0.5) / kSize, 1 - (row + 0.5) / kSize);
            defect.faces.push_back(surface.origin[first[texel]].face);
            defect.faces.push_back(surface.origin[second[texel]].face);
        }
        defect.place /= static_cast<double>(texels.size());
        defect.faces = ascending(defect.faces);
        defect.text = fmt::format(
            "charts lie on each other around ({:.3f}, {:.3f}), over {:.2g} % of the texture (faces {} and {} "
            "among "
            "others): pack the charts apart",
            defect.place.x(), defect.place.y(),
            100 * static_cast<double>(texels.size()) / (static_cast<double>(kSize) * kSize),
            surface.origin[first[texels[0]]].face, surface.origin[second[texels[0]]].face);
        defects.push_back(defect);
    }
}

}  // namespace

std::vector<UvDefect> uv_defects(const SurfaceMesh& mesh) {
    std::vector<UvDefect> defects = missing_uvs(mesh);
    // What is nowhere cannot lie outside or on something.
    if (!defects.empty()) return defects;
    const TriangleSurface surface = welded_triangles(mesh);
    find_outside(mesh, defects);
    find_without_area(mesh, surface, defects);
    const double cover = cover_of(mesh, surface);
    if (cover < kMostCover)
        find_overlaps(mesh, surface, defects);
    else
        defects.push_back(
            {UvDefectKind::Overlap,
             {0.5, 0.5},
             {},
             fmt::format("the faces would cover the texture {:.0f} times: unwrap the mesh and pack "
                         "the charts apart",
                         cover)});
    return defects;
}

void require_uvs(const SurfaceMesh& mesh, const std::string& name) {
    const auto defects = uv_defects(mesh);
    if (defects.empty()) return;
    std::string text = fmt::format("{}: its texture coordinates cannot carry maps:", name);
    for (std::size_t i = 0; i < std::min(defects.size(), kUvDefectsNamed); ++i)
        text += "\n  " + defects[i].text;
    if (defects.size() > kUvDefectsNamed)
        text += fmt::format("\n  and {} more", defects.size() - kUvDefectsNamed);
    throw InputError(text);
}

}  // namespace windfall::geometry
