#include "decay/skin_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

namespace windfall::decay {

namespace {

using geometry::Vec3;

struct Link {
    double spring = 0;
    double weight = 0;
};

/// Per vertex, by neighbour.
std::vector<std::map<std::int32_t, Link>> links_of(const geometry::BrickSurface& brick,
                                                   const std::vector<Vec3>& x) {
    std::vector<std::map<std::int32_t, Link>> links(x.size());
    const auto add = [&](std::int32_t a, std::int32_t b, double share_of_area, double weight) {
        const double spring = share_of_area / (x[a] - x[b]).squaredNorm();
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
            links[from][to].spring += spring;
            links[from][to].weight = weight;
        }
    };
    for (const auto& q : brick.quads) {
        const double area = 0.5 * (x[q[2]] - x[q[0]]).cross(x[q[3]] - x[q[1]]).norm();
        for (int k = 0; k < 4; ++k) add(q[k], q[(k + 1) % 4], 0.375 * area, 4);
        for (int k = 0; k < 2; ++k) add(q[k], q[k + 2], 0.75 * area, 1);
    }
    return links;
}

/// Greedy colouring of the vertices so that no two of a colour are within two links.
std::vector<int> colours_of(const std::vector<std::map<std::int32_t, Link>>& links) {
    std::vector<int> colour(links.size(), -1);
    for (std::size_t v = 0; v < links.size(); ++v) {
        std::uint64_t taken = 0;
        const auto take = [&](std::int32_t other) {
            if (colour[other] >= 0) taken |= std::uint64_t{1} << static_cast<unsigned>(colour[other]);
        };
        for (const auto& [near, _] : links[v]) {
            take(near);
            for (const auto& [next, unused] : links[near]) take(next);
        }
        int free = 0;
        while ((taken >> static_cast<unsigned>(free)) & 1U) ++free;
        colour[v] = free;
    }
    return colour;
}

}  // namespace

SkinMesh make_skin_mesh(const geometry::BrickSurface& brick, const std::vector<Vec3>& positions) {
    const auto links = links_of(brick, positions);
    const auto colours = colours_of(links);
    const std::size_t n = positions.size();
    SkinMesh mesh;
    mesh.vertex_of.resize(n);
    std::iota(mesh.vertex_of.begin(), mesh.vertex_of.end(), 0);
    std::stable_sort(mesh.vertex_of.begin(), mesh.vertex_of.end(),
                     [&](auto a, auto b) { return colours[a] < colours[b]; });
    std::vector<std::int32_t> place(n);
    for (std::size_t i = 0; i < n; ++i) place[mesh.vertex_of[i]] = static_cast<std::int32_t>(i);
    for (std::size_t i = 0; i < n; ++i)
        if (i == 0 || colours[mesh.vertex_of[i]] != colours[mesh.vertex_of[i - 1]])
            mesh.colour_begin.push_back(static_cast<std::int32_t>(i));
    mesh.colour_begin.push_back(static_cast<std::int32_t>(n));

    for (const auto& q : brick.quads)
        mesh.quads.push_back({place[q[0]], place[q[1]], place[q[2]], place[q[3]]});

    const auto areas = geometry::vertex_areas(positions, {brick.quads.begin(), brick.quads.end()});
    const auto total_weight = [&](std::int32_t v) {
        double sum = 0;
        for (const auto& [_, link] : links[v]) sum += link.weight;
        return sum;
    };
    double edges = 0;
    std::size_t edge_count = 0;
    mesh.begin.push_back(0);
    for (std::size_t i = 0; i < n; ++i) {
        const auto v = mesh.vertex_of[i];
        const double total = total_weight(v);
        double mean_square = 0;
        for (const auto& [w, link] : links[v]) {
            const double length_sq = (positions[v] - positions[w]).squaredNorm();
            mean_square += link.weight / total * length_sq;
            if (link.weight > 1) {
                edges += std::sqrt(length_sq);
                ++edge_count;
            }
            mesh.neighbours.push_back(
                {place[w], static_cast<float>(link.spring), static_cast<float>(link.weight / total)});
            mesh.weight_back.push_back(static_cast<float>(link.weight / total_weight(w)));
        }
        mesh.begin.push_back(static_cast<std::int32_t>(mesh.neighbours.size()));
        mesh.area_m2.push_back(static_cast<float>(areas[v]));
        mesh.bending.push_back(static_cast<float>(16 * areas[v] / (mean_square * mean_square)));
    }
    mesh.mean_edge_m = edges / static_cast<double>(edge_count);
    return mesh;
}

}  // namespace windfall::decay
