#include "geometry/surface_check_handles.h"

#include <algorithm>

namespace windfall::geometry {

namespace {

/// Steps from a root of the same component, and the way back there.
struct Ways {
    std::vector<std::int32_t> parent, steps;  ///< of roots: -1 and 0
};

Ways shortest_ways(const SurfaceEdges& edges, std::size_t vertices) {
    std::vector<std::vector<std::int32_t>> neighbours(vertices);
    for (const SurfaceEdge& edge : edges) {
        neighbours[edge.low].push_back(edge.high);
        neighbours[edge.high].push_back(edge.low);
    }
    Ways ways{std::vector<std::int32_t>(vertices, -1), std::vector<std::int32_t>(vertices, -1)};
    std::vector<std::int32_t> queue;
    for (std::size_t root = 0; root < vertices; ++root) {
        if (ways.steps[root] >= 0) continue;
        ways.steps[root] = 0;
        queue.assign(1, static_cast<std::int32_t>(root));
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::int32_t v = queue[i];
            for (const std::int32_t next : neighbours[v]) {
                if (ways.steps[next] >= 0) continue;
                ways.steps[next] = ways.steps[v] + 1;
                ways.parent[next] = v;
                queue.push_back(next);
            }
        }
    }
    return ways;
}

/// The vertices from both ends of an edge up to where their ways to the root meet.
std::vector<std::int32_t> loop_through(const SurfaceEdge& edge, const Ways& ways) {
    std::vector<std::int32_t> loop;
    std::int32_t a = edge.low, b = edge.high;
    while (a != b) {
        std::int32_t& further = ways.steps[a] >= ways.steps[b] ? a : b;
        loop.push_back(further);
        further = ways.parent[further];
    }
    loop.push_back(a);
    return loop;
}

}  // namespace

std::vector<std::int32_t> handle_loop(const SurfaceEdges& edges, std::size_t vertices,
                                      std::size_t triangles) {
    const Ways ways = shortest_ways(edges, vertices);
    std::vector<const SurfaceEdge*> outside_tree;
    for (const SurfaceEdge& edge : edges)
        if (ways.parent[edge.low] != edge.high && ways.parent[edge.high] != edge.low)
            outside_tree.push_back(&edge);
    // The cotree takes the edges of long loops first, so that short ones are left over.
    const auto length = [&](const SurfaceEdge* e) { return ways.steps[e->low] + ways.steps[e->high]; };
    std::stable_sort(outside_tree.begin(), outside_tree.end(),
                     [&](const SurfaceEdge* a, const SurfaceEdge* b) { return length(a) > length(b); });
    GrowingSets cotree(triangles);
    std::vector<std::int32_t> shortest;
    for (const SurfaceEdge* edge : outside_tree) {
        if (cotree.join(edge->first->triangle, (edge->first + 1)->triangle)) continue;
        auto loop = loop_through(*edge, ways);
        if (shortest.empty() || loop.size() < shortest.size()) shortest = std::move(loop);
    }
    return shortest;
}

}  // namespace windfall::geometry
