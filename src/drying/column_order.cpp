#include "drying/column_order.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace windfall::drying {

namespace {

using geometry::BrickSurface;

constexpr int kPatchCells = 8;

int patches_along(int cells) { return std::max(1, (cells + kPatchCells / 2) / kPatchCells); }

/// Patch numbers side by side; `first` is the number of a side's first patch.
struct PatchGrid {
    std::array<int, 6> first{};
    int count = 0;
    explicit PatchGrid(const BrickSurface& brick) {
        for (int side = 0; side < 6; ++side) {
            const auto [a, b] = geometry::side_axes(side);
            first[side] = count;
            count += patches_along(brick.cells[a]) * patches_along(brick.cells[b]);
        }
    }
};

std::vector<int> patch_of_vertices(const BrickSurface& brick) {
    const PatchGrid grid(brick);
    std::vector<int> patch(brick.vertex_count(), -1);
    for (int side = 0; side < 6; ++side) {
        const auto [a, b] = geometry::side_axes(side);
        const int na = brick.cells[a];
        const int nb = brick.cells[b];
        for (int j = 0; j <= nb; ++j)
            for (int i = 0; i <= na; ++i) {
                int& p = patch[brick.side_vertices[side][j * (na + 1) + i]];
                if (p >= 0) continue;
                p = grid.first[side] + j * patches_along(nb) / (nb + 1) * patches_along(na) +
                    i * patches_along(na) / (na + 1);
            }
    }
    return patch;
}

std::vector<int> patch_of_quads(const BrickSurface& brick) {
    const PatchGrid grid(brick);
    std::vector<int> patch;
    patch.reserve(brick.quads.size());
    for (int side = 0; side < 6; ++side) {
        const auto [a, b] = geometry::side_axes(side);
        const int na = brick.cells[a];
        const int nb = brick.cells[b];
        for (int j = 0; j < nb; ++j)
            for (int i = 0; i < na; ++i)
                patch.push_back(grid.first[side] + j * patches_along(nb) / nb * patches_along(na) +
                                i * patches_along(na) / na);
    }
    return patch;
}

/// First free colour for each patch in turn; patches in a common group must differ.
std::vector<int> colour_patches(int patch_count, const std::vector<std::vector<int>>& groups) {
    std::vector<std::set<int>> conflicts(patch_count);
    for (const auto& group : groups)
        for (const int p : group) conflicts[p].insert(group.begin(), group.end());
    std::vector<int> colour(patch_count, -1);
    for (int p = 0; p < patch_count; ++p) {
        std::set<int> taken;
        for (const int other : conflicts[p]) taken.insert(colour[other]);
        int c = 0;
        while (taken.count(c) > 0) ++c;
        colour[p] = c;
    }
    return colour;
}

/// Sorts items by (colour of their patch, patch), keeping their order within a patch, and notes the ranges.
Schedule schedule_of(const std::vector<int>& patch, const std::vector<int>& colour,
                     std::vector<std::int32_t>& order) {
    order.resize(patch.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t x, std::int32_t y) {
        return std::pair(colour[patch[x]], patch[x]) < std::pair(colour[patch[y]], patch[y]);
    });
    Schedule schedule;
    int last_patch = -1;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(order.size()); ++i) {
        const int p = patch[order[i]];
        if (p != last_patch) {
            schedule.resize(colour[p] + 1);
            schedule.back().push_back({i, i});
            last_patch = p;
        }
        schedule.back().back().end = i + 1;
    }
    return schedule;
}

std::vector<std::vector<std::int32_t>> neighbours_of(const BrickSurface& brick) {
    std::vector<std::vector<std::int32_t>> neighbours(brick.vertex_count());
    for (const auto& quad : brick.quads)
        for (const std::int32_t v : quad)
            for (const std::int32_t w : quad)
                if (v != w) neighbours[v].push_back(w);
    for (auto& list : neighbours) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return neighbours;
}

std::vector<int> distinct(std::vector<int> items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
    return items;
}

void order_columns(const BrickSurface& brick, const std::vector<std::vector<std::int32_t>>& neighbours,
                   ColumnOrder& result) {
    const std::vector<int> patch = patch_of_vertices(brick);
    std::vector<std::vector<int>> groups;
    for (std::size_t v = 0; v < patch.size(); ++v) {
        std::vector<int> group{patch[v]};
        for (const std::int32_t w : neighbours[v]) group.push_back(patch[w]);
        groups.push_back(distinct(group));
    }
    result.columns =
        schedule_of(patch, colour_patches(PatchGrid(brick).count, groups), result.vertex_of_solver);
    result.solver_of_vertex.resize(patch.size());
    for (std::size_t i = 0; i < patch.size(); ++i)
        result.solver_of_vertex[result.vertex_of_solver[i]] = static_cast<std::int32_t>(i);
}

void order_quads(const BrickSurface& brick, ColumnOrder& result) {
    const std::vector<int> patch = patch_of_quads(brick);
    std::vector<std::vector<int>> groups(brick.vertex_count());
    for (std::size_t q = 0; q < patch.size(); ++q)
        for (const std::int32_t v : brick.quads[q]) groups[v].push_back(patch[q]);
    for (auto& group : groups) group = distinct(group);
    result.quad_ranges =
        schedule_of(patch, colour_patches(PatchGrid(brick).count, groups), result.brick_quad);
    for (const std::int32_t q : result.brick_quad) {
        std::array<std::int32_t, 4> quad{};
        for (int c = 0; c < 4; ++c) quad[c] = result.solver_of_vertex[brick.quads[q][c]];
        result.quads.push_back(quad);
    }
}

void make_graph(const std::vector<std::vector<std::int32_t>>& neighbours, ColumnOrder& result) {
    const std::int32_t columns = result.column_count();
    result.lower_begin.assign(1, 0);
    for (std::int32_t v = 0; v < columns; ++v) {
        std::vector<std::int32_t> row;
        for (const std::int32_t w : neighbours[result.vertex_of_solver[v]])
            if (result.solver_of_vertex[w] < v) row.push_back(result.solver_of_vertex[w]);
        std::sort(row.begin(), row.end());
        result.lower_column.insert(result.lower_column.end(), row.begin(), row.end());
        result.lower_begin.push_back(static_cast<std::int32_t>(result.lower_column.size()));
    }
    std::vector<std::vector<std::array<std::int32_t, 2>>> upper(columns);
    for (std::int32_t v = 0; v < columns; ++v)
        for (std::int32_t e = result.lower_begin[v]; e < result.lower_begin[v + 1]; ++e)
            upper[result.lower_column[e]].push_back({v, e});
    result.upper_begin.assign(1, 0);
    for (const auto& row : upper) {
        for (const auto& [column, entry] : row) {
            result.upper_column.push_back(column);
            result.upper_entry.push_back(entry);
        }
        result.upper_begin.push_back(static_cast<std::int32_t>(result.upper_column.size()));
    }
}

void find_pair_entries(ColumnOrder& result) {
    constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    for (const auto& quad : result.quads) {
        std::array<std::int32_t, 6> entries{};
        for (int p = 0; p < 6; ++p) {
            const auto [low, high] = std::minmax(quad[kPairs[p][0]], quad[kPairs[p][1]]);
            const auto begin = result.lower_column.begin() + result.lower_begin[high];
            const auto end = result.lower_column.begin() + result.lower_begin[high + 1];
            entries[p] =
                static_cast<std::int32_t>(std::lower_bound(begin, end, low) - result.lower_column.begin());
        }
        result.pair_entry.push_back(entries);
    }
}

}  // namespace

ColumnOrder make_column_order(const geometry::BrickSurface& brick) {
    ColumnOrder result;
    const auto neighbours = neighbours_of(brick);
    order_columns(brick, neighbours, result);
    order_quads(brick, result);
    make_graph(neighbours, result);
    find_pair_entries(result);
    return result;
}

}  // namespace windfall::drying
