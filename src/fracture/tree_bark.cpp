#include "fracture/tree_bark.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace windfall::fracture {
namespace {

using geometry::Vec2;
using geometry::Vec3;

void normalize(double* v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0; ++k) v[k] /= length;
}

Vec2 pair_at(const std::vector<double>& values, std::ptrdiff_t at) {
    return {values[static_cast<std::size_t>(at)], values[static_cast<std::size_t>(at) + 1]};
}

}  // namespace

TreeBark::TreeBark(const meshfile::Mesh& mesh, const TreeSurface& surface)
    : m_mesh(mesh), m_surface(surface), m_count(mesh.values_per_corner()) {
    std::ptrdiff_t at = 0;
    for (const meshfile::Attribute& attribute : mesh.attributes) {
        if (attribute.role == meshfile::Role::TextureCoordinate && m_texture < 0) m_texture = at;
        at += attribute.components;
    }
}

const meshfile::FaceInfo& TreeBark::face_of(std::int32_t triangle) const {
    return m_mesh
        .faces[static_cast<std::size_t>(m_surface.triangles[static_cast<std::size_t>(triangle)].face)];
}

void TreeBark::read(std::int32_t triangle, const Vec3& weights, double* values) const {
    const TreeTriangle& t = m_surface.triangles[static_cast<std::size_t>(triangle)];
    std::vector<double> corner(m_count);
    std::fill(values, values + m_count, 0.0);
    int nearest = 0;
    weights.maxCoeff(&nearest);
    for (int k = 0; k < 3; ++k) {
        meshfile::corner_values(m_mesh, t.corners[static_cast<std::size_t>(k)], corner.data());
        for (std::size_t i = 0; i < m_count; ++i) values[i] += weights[k] * corner[i];
    }
    // The fourth number of a tangent is the side of the third axis, 1 or -1: nothing to be mixed.
    meshfile::corner_values(m_mesh, t.corners[static_cast<std::size_t>(nearest)], corner.data());
    std::size_t at = 0;
    for (const meshfile::Attribute& attribute : m_mesh.attributes) {
        const bool is_tangent = attribute.role == meshfile::Role::Tangent;
        if (is_tangent || attribute.role == meshfile::Role::Normal) normalize(values + at);
        if (is_tangent) values[at + 3] = corner[at + 3];
        at += static_cast<std::size_t>(attribute.components);
    }
}

Vec3 TreeBark::weights_beyond(std::int32_t triangle, const Vec3& position) const {
    const TreeTriangle& t = m_surface.triangles[static_cast<std::size_t>(triangle)];
    const Vec3& a = m_surface.corner(t, 0);
    const Vec3 ab = m_surface.corner(t, 1) - a, ac = m_surface.corner(t, 2) - a, ap = position - a;
    const Vec3 normal = ab.cross(ac);
    const double square = normal.squaredNorm();
    const double v = ap.cross(ac).dot(normal) / square, w = ab.cross(ap).dot(normal) / square;
    return {1 - v - w, v, w};
}

void TreeBark::read_in_chart(std::int32_t triangle, const Vec3& position,
                             std::span<const SurfacePlace> places, double* values) const {
    const std::int32_t group = face_of(triangle).group;
    const SurfacePlace* direct = nullptr;
    for (const SurfacePlace& place : places) {
        if (place.triangle == triangle) return read(triangle, place.weights, values);
        if (direct == nullptr && face_of(place.triangle).group == group) direct = &place;
    }
    const Vec3 beyond = weights_beyond(triangle, position);
    const bool has_plane = beyond.allFinite();
    if (direct == nullptr) return read(triangle, has_plane ? beyond : places[0].weights, values);
    read(direct->triangle, direct->weights, values);
    if (m_texture < 0 || !has_plane) return;

    // Without a seam the two differ by little against how far the texture runs over both triangles and over
    // the way between them.
    std::vector<double> continued(m_count), here(m_count);
    read(triangle, beyond, continued.data());
    const auto extent = [&](std::int32_t of) {
        double most = 0;
        std::vector<double> a(m_count), b(m_count);
        for (int k = 0; k < 3; ++k) {
            read(of, Vec3::Unit(k), a.data());
            read(of, Vec3::Unit((k + 1) % 3), b.data());
            most = std::max(most, (pair_at(a, m_texture) - pair_at(b, m_texture)).norm());
        }
        return most;
    };
    read(triangle, Vec3::Constant(1.0 / 3), here.data());
    const Vec2 jump = Vec2(values[m_texture], values[m_texture + 1]) - pair_at(continued, m_texture);
    const double way = (pair_at(continued, m_texture) - pair_at(here, m_texture)).norm();
    if (jump.norm() > 0.5 * (extent(triangle) + extent(direct->triangle) + way))
        std::copy(continued.begin(), continued.end(), values);
}

}  // namespace windfall::fracture
