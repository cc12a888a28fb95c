#include "geometry/uv_raster.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace windfall::geometry {

namespace {

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

std::array<Vec2, 3> uvs_of(const SurfaceMesh& mesh, const TriangleOrigin& origin) {
    const auto& uvs = mesh.corner_uvs[origin.face];
    return {uvs[origin.corner[0]], uvs[origin.corner[1]], uvs[origin.corner[2]]};
}

Vec2 uv_at(const SurfaceMesh& mesh, const TriangleSurface& surface, const SurfacePlace& place) {
    const auto uvs = uvs_of(mesh, surface.origin[static_cast<std::size_t>(place.triangle)]);
    return place.weights[0] * uvs[0] + place.weights[1] * uvs[1] + place.weights[2] * uvs[2];
}

void for_each_texel(const std::array<Vec2, 3>& uvs, int size,
                    const std::function<void(int x, int y, const Vec3& weights)>& visit) {
    std::array<Vec2, 3> p;  // in texels, y downwards, texel centres at whole numbers
    for (int k = 0; k < 3; ++k) p[k] = Vec2(uvs[k].x() * size - 0.5, (1 - uvs[k].y()) * size - 0.5);
    const double whole = twice_area(p[0], p[1], p[2]);
    if (whole == 0) return;
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [top, bottom] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const int first_x = std::max(0, static_cast<int>(std::ceil(std::max(left, 0.0))));
    const int last_x = static_cast<int>(std::floor(std::min(right, size - 1.0)));
    const int first_y = std::max(0, static_cast<int>(std::ceil(std::max(top, 0.0))));
    const int last_y = static_cast<int>(std::floor(std::min(bottom, size - 1.0)));
    for (int y = first_y; y <= last_y; ++y)
        for (int x = first_x; x <= last_x; ++x) {
            const Vec2 centre(x, y);
            const Vec3 weights = Vec3(twice_area(p[1], p[2], centre), twice_area(p[2], p[0], centre),
                                      twice_area(p[0], p[1], centre)) /
                                 whole;
            if (weights.minCoeff() >= 0) visit(x, y, weights);
        }
}

UvRaster::UvRaster(const SurfaceMesh& mesh, const TriangleSurface& surface, int size, int gutter)
    : m_size(size) {
    if (size < kSmallest || size > kLargest)
        throw InputError(fmt::format("a texture of {0} x {0} texels cannot be: give a side from {1} to {2}",
                                     size, kSmallest, kLargest));
    if (mesh.faces.empty() || mesh.corner_uvs.size() != mesh.faces.size())
        throw InputError("the mesh has no texture coordinates: unwrap it");
    m_texels.resize(static_cast<std::size_t>(size) * size);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for_each_texel(uvs_of(mesh, surface.origin[t]), size, [&](int x, int y, const Vec3& weights) {
            m_texels[static_cast<std::size_t>(y) * size + x] = {
                static_cast<std::int32_t>(t), static_cast<float>(weights[1]), static_cast<float>(weights[2])};
        });
    m_chart_texels = std::count_if(m_texels.begin(), m_texels.end(),
                                   [](const Texel& texel) { return texel.triangle >= 0; });
    for (int k = 0; k < gutter; ++k) widen();
}

void UvRaster::widen() {
    // Sides before corners, so that a texel takes the nearer place.
    constexpr std::array<std::array<int, 2>, 8> kAround = {
        {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    std::vector<std::pair<std::size_t, Texel>> added;
    for (int y = 0; y < m_size; ++y)
        for (int x = 0; x < m_size; ++x) {
            const std::size_t here = static_cast<std::size_t>(y) * m_size + x;
            if (covered(here)) continue;
            for (const auto& [dx, dy] : kAround) {
                if (x + dx < 0 || x + dx >= m_size || y + dy < 0 || y + dy >= m_size) continue;
                const std::size_t there = static_cast<std::size_t>(y + dy) * m_size + x + dx;
                if (!covered(there)) continue;
                added.emplace_back(here, m_texels[there]);
                break;
            }
        }
    for (const auto& [texel, value] : added) m_texels[texel] = value;
}

}  // namespace windfall::geometry
