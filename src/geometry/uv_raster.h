#pragma once
// Which place of a surface each texel of its own texture shows.
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// Calls visit(x, y, weights) for every texel (y counted from the top) whose centre lies in a triangle of
/// texture coordinates (v up), and weights of the triangle's corners there. Centres outside the square are
/// left out.
void for_each_texel(const std::array<Vec2, 3>& uvs, int size,
                    const std::function<void(int x, int y, const Vec3& weights)>& visit);

/// Texture coordinates of a triangle's corners.
std::array<Vec2, 3> uvs_of(const SurfaceMesh& mesh, const TriangleOrigin& origin);

/// Texture coordinates of a place on `surface`, welded_triangles(mesh).
Vec2 uv_at(const SurfaceMesh& mesh, const TriangleSurface& surface, const SurfacePlace& place);

/// Immutable; safe to read from several threads.
class UvRaster {
  public:
    static constexpr int kSmallest = 16, kLargest = 4096, kGutter = 4;

    /// `surface` must be welded_triangles(mesh). Where charts overlap the last triangle wins. Charts are
    /// widened by `gutter` texels with the places at their rims, so that filtering finds no background.
    /// Throws InputError without texture coordinates and for sizes out of range.
    UvRaster(const SurfaceMesh& mesh, const TriangleSurface& surface, int size, int gutter = kGutter);

    int size() const { return m_size; }
    /// What a texel (size() * y + x, y from the top) shows; nothing: triangle -1.
    SurfacePlace place(std::size_t texel) const {
        const Texel& t = m_texels[texel];
        return {t.triangle, Vec3(1.0 - t.second - t.third, t.second, t.third)};
    }
    bool covered(std::size_t texel) const { return m_texels[texel].triangle >= 0; }
    std::size_t texel_count() const { return m_texels.size(); }
    /// How many texels are covered, without the gutters.
    std::size_t chart_texels() const { return m_chart_texels; }

  private:
    struct Texel {
        std::int32_t triangle = -1;
        float second = 0, third = 0;  ///< weights of the triangle's corners
    };
    void widen();

    int m_size;
    std::size_t m_chart_texels = 0;
    std::vector<Texel> m_texels;
};

}  // namespace windfall::geometry
