#include "geometry/brick_surface.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace windfall::geometry {

std::array<int, 2> side_axes(int side) {
    const int axis = side / 2;
    const bool high = side % 2 == 1;
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    return high ? std::array<int, 2>{a, b} : std::array<int, 2>{b, a};
}

std::int32_t BrickSurface::vertex_at(const Lattice& point) const {
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        if (point[axis] != (side % 2 == 1 ? cells[axis] : 0)) continue;
        const auto [a, b] = side_axes(side);
        if (point[a] < 0 || point[a] > cells[a] || point[b] < 0 || point[b] > cells[b]) return -1;
        return side_vertices[side][point[b] * (cells[a] + 1) + point[a]];
    }
    return -1;
}

BrickSurface make_brick_surface(const Lattice& cells) {
    if (*std::min_element(cells.begin(), cells.end()) < 1)
        throw InputError(
            fmt::format("a brick of {} x {} x {} cells has no surface", cells[0], cells[1], cells[2]));
    BrickSurface brick;
    brick.cells = cells;
    for (int side = 0; side < 6; ++side) {
        const auto [a, b] = side_axes(side);
        const int axis = side / 2;
        auto& grid = brick.side_vertices[side];
        grid.assign(static_cast<std::size_t>(cells[a] + 1) * (cells[b] + 1), -1);
        for (int j = 0; j <= cells[b]; ++j) {
            for (int i = 0; i <= cells[a]; ++i) {
                Lattice point{};
                point[axis] = side % 2 == 1 ? cells[axis] : 0;
                point[a] = i;
                point[b] = j;
                // Sides already done own the edges they share with this one.
                std::int32_t vertex = -1;
                for (int earlier = 0; earlier < side && vertex < 0; ++earlier) {
                    const int other = earlier / 2;
                    if (point[other] != (earlier % 2 == 1 ? cells[other] : 0)) continue;
                    const auto [c, d] = side_axes(earlier);
                    vertex = brick.side_vertices[earlier][point[d] * (cells[c] + 1) + point[c]];
                }
                if (vertex < 0) {
                    vertex = static_cast<std::int32_t>(brick.lattice.size());
                    brick.lattice.push_back(point);
                }
                grid[j * (cells[a] + 1) + i] = vertex;
            }
        }
        const int row = cells[a] + 1;
        const auto at = [&grid, row](int i, int j) { return grid[j * row + i]; };
        for (int j = 0; j < cells[b]; ++j) {
            for (int i = 0; i < cells[a]; ++i) {
                brick.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    }
    return brick;
}

std::vector<std::array<Vec2, 4>> brick_atlas(const BrickSurface& brick) {
    constexpr double kMargin = 1.0 / 128;
    const Vec2 chart_size(1.0 / 3, 1.0 / 2);
    std::vector<std::array<Vec2, 4>> uvs(brick.quads.size());
    std::size_t q = 0;
    for (int side = 0; side < 6; ++side) {
        const auto [a, b] = side_axes(side);
        const int chart_row = side / 3;
        const Vec2 origin(side % 3 * chart_size.x() + kMargin, chart_row * chart_size.y() + kMargin);
        const Vec2 extent = chart_size - Vec2::Constant(2 * kMargin);
        // Texels keep their aspect: the longer side of the chart fills its cell.
        const double longest = std::max(brick.cells[a] / extent.x(), brick.cells[b] / extent.y());
        for (int j = 0; j < brick.cells[b]; ++j) {
            for (int i = 0; i < brick.cells[a]; ++i, ++q) {
                const auto uv = [&](int di, int dj) -> Vec2 {
                    return origin + Vec2(i + di, j + dj) / longest;
                };
                uvs[q] = {uv(0, 0), uv(1, 0), uv(1, 1), uv(0, 1)};
            }
        }
    }
    return uvs;
}

bool can_coarsen(const Lattice& cells) {
    return std::all_of(cells.begin(), cells.end(), [](int n) { return n % 2 == 0 && n >= 4; });
}

Lattice coarser(const Lattice& cells) { return {cells[0] / 2, cells[1] / 2, cells[2] / 2}; }

std::vector<Parents> brick_parents(const BrickSurface& fine, const BrickSurface& coarse) {
    std::vector<Parents> result(fine.vertex_count());
    for (std::size_t v = 0; v < result.size(); ++v) {
        std::array<Lattice, 4> points{fine.lattice[v]};
        int count = 1;
        for (int axis = 0; axis < 3; ++axis) {
            if (fine.lattice[v][axis] % 2 == 0) continue;
            for (int p = 0; p < count; ++p) {
                points[count + p] = points[p];
                --points[p][axis];
                ++points[count + p][axis];
            }
            count *= 2;
        }
        result[v].count = count;
        for (int p = 0; p < count; ++p)
            result[v].vertex[p] = coarse.vertex_at({points[p][0] / 2, points[p][1] / 2, points[p][2] / 2});
    }
    return result;
}

}  // namespace windfall::geometry
