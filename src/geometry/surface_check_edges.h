#pragma once
// Edges of a triangle surface with the triangles on them, and sets that grow together.
#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// A triangle on an edge; `forward` where it runs from the lower to the higher vertex.
struct EdgeUse {
    std::int32_t triangle = 0;
    bool forward = false;
};

struct SurfaceEdge {
    std::int32_t low = 0, high = 0;  ///< its vertices
    std::vector<EdgeUse>::const_iterator first, last;

    auto begin() const { return first; }
    auto end() const { return last; }
    std::ptrdiff_t uses() const { return last - first; }
    /// Whether two triangles meet here, one on each side.
    bool sound() const { return uses() == 2 && first->forward != (first + 1)->forward; }
};

/// Every edge once, sorted by its vertices. Refers into itself: neither copied nor moved.
class SurfaceEdges {
  public:
    explicit SurfaceEdges(const std::vector<Triangle>& triangles);
    ~SurfaceEdges() = default;
    SurfaceEdges(const SurfaceEdges&) = delete;
    SurfaceEdges& operator=(const SurfaceEdges&) = delete;

    auto begin() const { return m_edges.begin(); }
    auto end() const { return m_edges.end(); }
    std::size_t size() const { return m_edges.size(); }
    const SurfaceEdge& operator[](std::size_t i) const { return m_edges[i]; }

  private:
    std::vector<EdgeUse> m_uses;
    std::vector<SurfaceEdge> m_edges;
};

/// Numbers 0 .. count - 1 in sets; each set is known by its smallest number.
class GrowingSets {
  public:
    explicit GrowingSets(std::size_t count) : m_parent(count) {
        std::iota(m_parent.begin(), m_parent.end(), 0);
    }
    std::int32_t set_of(std::int32_t i) {
        while (m_parent[i] != i) i = m_parent[i] = m_parent[m_parent[i]];
        return i;
    }
    /// Gives whether they were in two sets.
    bool join(std::int32_t i, std::int32_t j) {
        const std::int32_t a = set_of(i), b = set_of(j);
        m_parent[std::max(a, b)] = std::min(a, b);
        return a != b;
    }
    /// The given numbers by set, sets ascending.
    std::map<std::int32_t, std::vector<std::int32_t>> sets_of(const std::vector<std::int32_t>& numbers) {
        std::map<std::int32_t, std::vector<std::int32_t>> sets;
        for (const std::int32_t i : numbers) sets[set_of(i)].push_back(i);
        return sets;
    }

  private:
    std::vector<std::int32_t> m_parent;
};

}  // namespace windfall::geometry
