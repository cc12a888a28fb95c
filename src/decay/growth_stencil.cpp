#include "decay/growth_stencil.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"

namespace windfall::decay {

namespace {

using geometry::CubeAtlas;
using geometry::Vec3;

struct SeamLink {
    std::uint32_t from = 0, to = 0;
    double weight = 0;
};

/// Adds triangles; links within a chart go into the fields, all others into a list.
class TriangleSum {
  public:
    TriangleSum(const CubeAtlas& atlas, std::span<const Vec3> positions, SurfaceStencil& stencil)
        : m_atlas(atlas), m_positions(positions), m_stencil(stencil), m_side(atlas.side()) {}

    void add_triangle(std::size_t a, std::size_t b, std::size_t c, std::vector<SeamLink>& seams) {
        add_link(b, c, 0.5 * cotangent(a, b, c), seams);
        add_link(c, a, 0.5 * cotangent(b, c, a), seams);
        add_link(a, b, 0.5 * cotangent(c, a, b), seams);
    }

    /// a, b, c, d in cyclic order.
    void add_quad(std::size_t a, std::size_t b, std::size_t c, std::size_t d, std::vector<SeamLink>& seams) {
        // Angles opposite the diagonal ac add up to at most pi where their cotangents do not to less than 0.
        if (cotangent(b, c, a) + cotangent(d, a, c) >= 0) {
            add_triangle(a, b, c, seams);
            add_triangle(a, c, d, seams);
        } else {
            add_triangle(b, c, d, seams);
            add_triangle(b, d, a, seams);
        }
    }

    double distance(std::size_t a, std::size_t b) const { return (m_positions[a] - m_positions[b]).norm(); }

  private:
    double cotangent(std::size_t at, std::size_t b, std::size_t c) const {
        const Vec3 e = m_positions[b] - m_positions[at];
        const Vec3 f = m_positions[c] - m_positions[at];
        const double twice_area = e.cross(f).norm();
        if (!(twice_area > 0 && std::isfinite(twice_area))) {
            const Vec3& p = m_positions[at];
            throw InputError(fmt::format(
                "the surface has no area near ({:.4g}, {:.4g}, {:.4g}) m: its map onto the texture folds or "
                "shrinks to a point there; repair the mesh",
                p.x(), p.y(), p.z()));
        }
        return e.dot(f) / twice_area;
    }

    void add_link(std::size_t i, std::size_t j, double weight, std::vector<SeamLink>& seams) {
        if (i > j) std::swap(i, j);
        if (m_atlas.chart_of(i) == m_atlas.chart_of(j)) {
            const std::size_t gap = j - i;
            TexelField* field = gap == 1            ? &m_stencil.east
                                : gap == m_side     ? &m_stencil.south
                                : gap == m_side + 1 ? &m_stencil.south_east
                                : gap == m_side - 1 ? &m_stencil.south_west
                                                    : nullptr;
            if (field != nullptr) {
                (*field)[i] += static_cast<float>(weight);
                return;
            }
        }
        seams.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), weight});
    }

    const CubeAtlas& m_atlas;
    std::span<const Vec3> m_positions;
    SurfaceStencil& m_stencil;
    std::size_t m_side;
};

/// The corner of the cube that a chart has at (s, t), as a number 0..7.
int cube_corner(int chart, int s, int t) {
    const Vec3 d = CubeAtlas::direction(chart, s, t);
    return (d.x() > 0 ? 1 : 0) + (d.y() > 0 ? 2 : 0) + (d.z() > 0 ? 4 : 0);
}

struct Borders {
    /// Per edge of the cube, by its corners, lower first: the texels of the two charts that meet there.
    std::map<std::pair<int, int>, std::vector<std::vector<std::size_t>>> edges;
    std::array<std::vector<std::size_t>, 8> corners;
};

Borders chart_borders(const CubeAtlas& atlas) {
    Borders borders;
    const int width = atlas.chart_width(), height = atlas.chart_height();
    for (int chart = 0; chart < 6; ++chart) {
        const auto [x0, y0] = atlas.chart_origin(chart);
        // (s, t) as whole numbers of texels from the lower left one; y runs down.
        const auto texel = [&, x = x0, y = y0](int s, int t) {
            return static_cast<std::size_t>(y + height - 1 - t) * atlas.side() + x + s;
        };
        constexpr std::array<std::array<int, 2>, 4> kTurn{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (int k = 0; k < 4; ++k) {
            const auto [s, t] = kTurn[k];
            const auto [next_s, next_t] = kTurn[(k + 1) % 4];
            const int from = cube_corner(chart, s, t);
            const int to = cube_corner(chart, next_s, next_t);
            borders.corners[from].push_back(texel(s * (width - 1), t * (height - 1)));
            std::vector<std::size_t> line;
            const int count = s != next_s ? width : height;
            for (int m = 0; m < count; ++m)
                line.push_back(
                    texel(s * (width - 1) + (next_s - s) * m, t * (height - 1) + (next_t - t) * m));
            if (from > to) std::reverse(line.begin(), line.end());
            borders.edges[{std::min(from, to), std::max(from, to)}].push_back(std::move(line));
        }
    }
    return borders;
}

void zip(TriangleSum& sum, const std::vector<std::size_t>& left, const std::vector<std::size_t>& right,
         std::vector<SeamLink>& seams) {
    std::size_t p = 0, q = 0;
    while (p + 1 < left.size() || q + 1 < right.size()) {
        const bool step_left = q + 1 >= right.size() ||
                               (p + 1 < left.size() &&
                                sum.distance(left[p + 1], right[q]) <= sum.distance(left[p], right[q + 1]));
        if (step_left) {
            sum.add_triangle(left[p], left[p + 1], right[q], seams);
            ++p;
        } else {
            sum.add_triangle(left[p], right[q + 1], right[q], seams);
            ++q;
        }
    }
}

/// Sorts the links, adds up those of one pair, and writes each from both its ends.
std::vector<SeamLink> merged(std::vector<SeamLink> links) {
    const auto by_pair = [](const SeamLink& a, const SeamLink& b) {
        return std::pair(a.from, a.to) < std::pair(b.from, b.to);
    };
    std::stable_sort(links.begin(), links.end(), by_pair);
    std::vector<SeamLink> result;
    for (const SeamLink& link : links) {
        if (!result.empty() && result.back().from == link.from && result.back().to == link.to)
            result.back().weight += link.weight;
        else
            result.push_back(link);
    }
    const std::size_t pairs = result.size();
    for (std::size_t k = 0; k < pairs; ++k)
        result.push_back({result[k].to, result[k].from, result[k].weight});
    std::sort(result.begin(), result.end(), by_pair);
    return result;
}

/// Voronoi areas from the weights, and weights clamped at 0.
class AreaSum {
  public:
    explicit AreaSum(std::size_t texels) : m_exact(texels, 0), m_clamped(texels, 0) {}
    /// The share of one end of a link.
    void add(std::size_t texel, double weight, double distance_sq) {
        m_exact[texel] += 0.25 * weight * distance_sq;
        m_clamped[texel] += 0.25 * std::max(weight, 0.0) * distance_sq;
    }
    /// note: triangles that are obtuse on both sides of a link, in a strongly skewed map, take area away;
    /// never let them take all of it.
    double area(std::size_t texel) const { return std::max(m_exact[texel], 0.25 * m_clamped[texel]); }

  private:
    std::vector<double> m_exact, m_clamped;
};

void add_field_areas(AreaSum& areas, TexelField& field, std::size_t gap, std::span<const Vec3> positions,
                     const std::vector<CubeAtlas::Run>& runs) {
    for (const CubeAtlas::Run& run : runs) {
        for (std::size_t i = run.begin; i < run.end; ++i) {
            if (field[i] == 0) continue;
            const double distance_sq = (positions[i] - positions[i + gap]).squaredNorm();
            areas.add(i, field[i], distance_sq);
            areas.add(i + gap, field[i], distance_sq);
            field[i] = std::max(field[i], 0.0F);
        }
    }
}

void set_seams(SurfaceStencil& stencil, const std::vector<SeamLink>& links) {
    for (const SeamLink& link : links) {
        if (stencil.seam_texels.empty() || stencil.seam_texels.back() != link.from) {
            stencil.seam_begin.push_back(static_cast<std::uint32_t>(stencil.seam_neighbour.size()));
            stencil.seam_texels.push_back(link.from);
        }
        stencil.seam_neighbour.push_back(link.to);
        stencil.seam_weight.push_back(static_cast<float>(std::max(link.weight, 0.0)));
    }
    stencil.seam_begin.push_back(static_cast<std::uint32_t>(stencil.seam_neighbour.size()));
}

}  // namespace

SurfaceStencil make_stencil(const CubeAtlas& atlas, std::span<const Vec3> texel_positions_m) {
    SurfaceStencil stencil;
    const int side = atlas.side();
    stencil.side = side;
    int slot = 0;
    for (TexelField* field : {&stencil.east, &stencil.south, &stencil.south_east, &stencil.south_west,
                              &stencil.inverse_area, &stencil.area_m2})
        *field = TexelField(side, slot++);

    TriangleSum sum(atlas, texel_positions_m, stencil);
    parallel_for_each(6, [&](std::size_t chart) {
        const auto [x0, y0] = atlas.chart_origin(static_cast<int>(chart));
        std::vector<SeamLink> none;
        for (int y = y0; y + 1 < y0 + atlas.chart_height(); ++y) {
            for (int x = x0; x + 1 < x0 + atlas.chart_width(); ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * side + x;
                sum.add_quad(i, i + 1, i + side + 1, i + side, none);
            }
        }
    });
    std::vector<SeamLink> seams;
    const Borders borders = chart_borders(atlas);
    for (const auto& [corners, lines] : borders.edges) zip(sum, lines[0], lines[1], seams);
    for (const auto& corner : borders.corners) sum.add_triangle(corner[0], corner[1], corner[2], seams);
    seams = merged(std::move(seams));

    AreaSum areas(atlas.texel_count());
    const auto runs = atlas.runs();
    const auto row = static_cast<std::size_t>(side);
    add_field_areas(areas, stencil.east, 1, texel_positions_m, runs);
    add_field_areas(areas, stencil.south, row, texel_positions_m, runs);
    add_field_areas(areas, stencil.south_east, row + 1, texel_positions_m, runs);
    add_field_areas(areas, stencil.south_west, row - 1, texel_positions_m, runs);
    for (const SeamLink& link : seams)
        areas.add(link.from, link.weight,
                  (texel_positions_m[link.from] - texel_positions_m[link.to]).squaredNorm());
    set_seams(stencil, seams);
    for (const CubeAtlas::Run& run : runs) {
        for (std::size_t i = run.begin; i < run.end; ++i) {
            stencil.inverse_area[i] = static_cast<float>(1 / areas.area(i));
            stencil.area_m2[i] = 1 / stencil.inverse_area[i];
        }
    }
    return stencil;
}

std::vector<float> link_sums(const SurfaceStencil& stencil) {
    const auto side = static_cast<std::size_t>(stencil.side);
    std::vector<float> sums(stencil.area_m2.size(), 0);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const float* east = stencil.east.data() + i;
        const float* south = stencil.south.data() + i;
        const float* south_east = stencil.south_east.data() + i;
        const float* south_west = stencil.south_west.data() + i;
        const auto up = static_cast<std::ptrdiff_t>(side);
        sums[i] = east[0] + east[-1] + south[0] + south[-up] + south_east[0] + south_east[-up - 1] +
                  south_west[0] + south_west[-up + 1];
    }
    for (std::size_t k = 0; k < stencil.seam_texels.size(); ++k)
        for (std::uint32_t link = stencil.seam_begin[k]; link < stencil.seam_begin[k + 1]; ++link)
            sums[stencil.seam_texels[k]] += stencil.seam_weight[link];
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] *= stencil.inverse_area[i];
    return sums;
}

}  // namespace windfall::decay
