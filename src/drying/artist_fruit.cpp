#include "drying/artist_fruit.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "geometry/laid_brick.h"
#include "geometry/layered_mesh.h"
#include "geometry/medial_radius.h"
#include "geometry/stone_lines.h"
#include "geometry/uv_raster.h"

namespace windfall::drying {

namespace {

using geometry::CurvedSurface;
using geometry::SurfaceMesh;
using geometry::Vec3;

/// Centre of the volume inside a closed surface.
Vec3 centre_of_volume(const geometry::TriangleSurface& surface) {
    Vec3 moment = Vec3::Zero();
    double volume = 0;
    const Vec3 origin = surface.positions.front();
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3 x = surface.positions[a] - origin, y = surface.positions[b] - origin,
                   z = surface.positions[c] - origin;
        const double share = x.dot(y.cross(z));
        moment += share * (x + y + z) / 4;
        volume += share;
    }
    return origin + moment / volume;
}

CurvedSurface ellipsoid(const Vec3& centre, const Vec3& half_axes) {
    constexpr int kCells = 24;
    const geometry::BrickSurface brick = geometry::make_brick_surface({kCells, kCells, kCells});
    SurfaceMesh mesh;
    for (const Vec3& d : geometry::brick_directions(brick, Vec3::Ones()))
        mesh.positions.emplace_back(centre + half_axes.cwiseProduct(d));
    mesh.faces.assign(brick.quads.begin(), brick.quads.end());
    return CurvedSurface(geometry::welded_triangles(mesh));
}

}  // namespace

double equivalent_radius(const SurfaceMesh& mesh) {
    return std::cbrt(3 * geometry::enclosed_volume(mesh.positions, mesh.faces) / (4 * std::numbers::pi));
}

ArtistFruit::ArtistFruit(const ArtistMeshes& meshes, const DryingParameters& parameters)
    : m_mesh(meshes.fruit),
      m_map(m_mesh),
      m_surface(m_map.surface()),
      m_r1(equivalent_radius(m_mesh)),
      m_elongation(parameters.mesh.elongation > 0 ? parameters.mesh.elongation
                                                  : geometry::best_elongation(m_surface, m_map)) {
    const FruitParameters& fruit = parameters.fruit;
    if (fruit.stone == StoneKind::Mesh && meshes.stone)
        m_stone.emplace(geometry::welded_triangles(*meshes.stone));
    if (fruit.stone == StoneKind::Ellipsoid)
        m_stone.emplace(ellipsoid(centre_of_volume(m_surface.triangles()),
                                  m_r1 * Vec3(fruit.stone_r2, fruit.stone_r1, fruit.stone_r2)));
    if (m_stone) geometry::require_inside(m_surface, *m_stone, 2 * fruit.skin_thickness * m_r1);
}

std::vector<Vec3> ArtistFruit::vertices() const {
    std::vector<Vec3> result = m_mesh.positions;
    for (Vec3& p : result) p /= m_r1;
    return result;
}

std::vector<geometry::Vec2> ArtistFruit::uvs_under(const geometry::LayeredMesh& mesh) const {
    if (m_mesh.corner_uvs.empty()) throw InputError("fruit.mesh has no texture coordinates to paint over");
    const std::vector<Vec3> skin = mesh.level_positions(mesh.layers);
    std::vector<geometry::Vec2> result;
    result.reserve(mesh.brick.quads.size());
    for (const geometry::Quad& quad : mesh.brick.quads) {
        Vec3 middle = Vec3::Zero(), outward = Vec3::Zero();
        for (const std::int32_t v : quad) {
            middle += m_r1 / 4 * skin[static_cast<std::size_t>(v)];
            outward += mesh.outward[static_cast<std::size_t>(v)];
        }
        geometry::SurfacePlace place = m_surface.nearest(middle, outward).place;
        if (place.triangle < 0) place = m_surface.nearest(middle).place;
        result.push_back(geometry::uv_at(m_mesh, m_surface.triangles(), place));
    }
    return result;
}

Thickness thickness_of(const SurfaceMesh& mesh, double skin_thickness) {
    constexpr std::size_t kMostPlaces = 4000;
    const CurvedSurface surface(geometry::welded_triangles(mesh));
    const auto& triangles = surface.triangles().triangles;
    const double largest = geometry::diagonal_of(mesh.positions);
    const std::size_t stride = (triangles.size() + kMostPlaces - 1) / kMostPlaces;
    Thickness result{std::numeric_limits<double>::infinity(), Vec3::Zero(), 0};
    double count = 0;
    for (std::size_t t = 0; t < triangles.size(); t += stride) {
        const geometry::SurfaceSpot spot =
            surface.at({static_cast<std::int32_t>(t), Vec3::Constant(1.0 / 3)});
        const double radius =
            geometry::medial_radius(surface.tree(), spot.point, spot.normal, largest, skin_thickness);
        result.mean += radius;
        count += 1;
        if (radius >= result.smallest) continue;
        result.smallest = radius;
        result.smallest_place = spot.point;
    }
    result.mean /= count;
    return result;
}

std::vector<std::string> check_thickness(const SurfaceMesh& mesh, const FruitParameters& fruit) {
    constexpr double kFewestSkins = 2, kFewSkins = 3;
    const double skin = fruit.skin_thickness * equivalent_radius(mesh);
    const Thickness thickness = thickness_of(mesh, skin);
    const double skins = thickness.smallest / skin;
    if (skins >= kFewSkins) return {};
    const Vec3& p = thickness.smallest_place;
    const std::string text = fmt::format(
        "the fruit is only {:.2g} skins thick to either side near ({:.4g}, {:.4g}, {:.4g}) of fruit.mesh: "
        "set "
        "fruit.skin_thickness = {:.2g}, or make the mesh thicker there",
        skins, p.x(), p.y(), p.z(), fruit.skin_thickness * skins / kFewSkins);
    if (skins < kFewestSkins) throw InputError(text);
    return {text};
}

}  // namespace windfall::drying
