#pragma once
// A square texture that holds a whole closed surface: the six sides of a cube as rectangles, 3 columns x 2
// rows.
//
// One convention throughout. Texture coordinates are those of OBJ: u to the right, v UP, both in [0, 1]. Maps
// are images, top row first: texel (x, y) is map[y * side + x] with y counted from the TOP; it covers u = x /
// side .. (x + 1) / side and v = 1 - (y + 1) / side .. 1 - y / side. (glTF's v is 1 - v: its writers turn it
// over.)
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/brick_surface.h"

namespace windfall::geometry {

/// Charts of a cube in a texture. Chart k is side k of a BrickSurface; its s runs along side_axes(k)[0] and
/// to the right, its t along side_axes(k)[1] and up. It stands in column k % 3 and in row k / 3 from the
/// bottom, fills its cell but for a gutter of kGutter texels on each side, and is spread in equal angles (tan
/// map), as brick_directions(brick, (1, 1, 1)) is. Immutable; safe to read from several threads.
class CubeAtlas {
  public:
    static constexpr int kGutter = 2;
    static constexpr int kSmallest = 64, kLargest = 4096;

    /// Throws InputError unless `side` is even and in kSmallest .. kLargest.
    explicit CubeAtlas(int side);

    int side() const { return m_side; }
    std::size_t texel_count() const { return static_cast<std::size_t>(m_side) * m_side; }
    int chart_width() const { return m_width; }
    int chart_height() const { return m_height; }
    /// Leftmost column and topmost row of a chart.
    std::array<int, 2> chart_origin(int chart) const;

    /// Texture coordinates of a point of a chart; s and t in [0, 1].
    Vec2 uv(int chart, double s, double t) const;
    /// Unit direction of a point of a chart; s and t a little outside [0, 1] go on past the edge.
    static Vec3 direction(int chart, double s, double t);

    /// A point of a chart.
    struct ChartPoint {
        int chart = 0;
        double s = 0, t = 0;
    };
    /// The point in a direction (any length but zero).
    static ChartPoint chart_point(const Vec3& direction);

    /// A point of the texture in texels: texel (i, j) has its centre at x = i + 0.5, y = j + 0.5, y
    /// downwards.
    struct TexelPoint {
        int chart = 0;
        double x = 0, y = 0;
    };
    TexelPoint texel_point(const ChartPoint& point) const;
    TexelPoint locate(const Vec3& direction) const { return texel_point(chart_point(direction)); }
    /// Index of the covered texel in a direction.
    std::size_t texel_at(const Vec3& direction) const;

    /// The chart that covers a texel; -1 in the gutters.
    int chart_of(std::size_t texel) const { return m_chart[texel]; }
    bool covered(std::size_t texel) const { return m_chart[texel] >= 0; }
    /// Unit direction of the centre of a covered texel.
    Vec3 texel_direction(std::size_t texel) const;

    /// The covered texels as runs [begin, end) of one row of one chart.
    struct Run {
        std::size_t begin = 0, end = 0;
        int chart = 0;
    };
    std::vector<Run> runs() const;

    /// Gives every gutter texel of `map` (texel_count() x channels values) the value that the surface has
    /// there across the seam, so that bilinear filtering shows no seam.
    void bleed(std::span<float> map, int channels = 1) const;

    /// Bilinear value of a one-channel map in a direction. The map must have been bled.
    float sample(std::span<const float> map, const Vec3& direction) const;

    /// Texture coordinates per corner of the brick's quads, in their order.
    std::vector<std::array<Vec2, 4>> corner_uvs(const BrickSurface& brick) const;

  private:
    /// A gutter texel as a weighted sum of four covered ones.
    struct Bleed {
        std::uint32_t texel = 0;
        std::array<std::uint32_t, 4> from{};
        std::array<float, 4> weight{};
    };
    void make_bleeds();

    int m_side, m_width = 0, m_height = 0;
    std::vector<std::int16_t> m_chart;
    std::vector<Bleed> m_bleeds;
};

}  // namespace windfall::geometry
