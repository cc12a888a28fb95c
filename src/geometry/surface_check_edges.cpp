#include "geometry/surface_check_edges.h"

#include <algorithm>

namespace windfall::geometry {

SurfaceEdges::SurfaceEdges(const std::vector<Triangle>& triangles) {
    struct Keyed {
        std::int32_t low, high;
        EdgeUse use;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const std::int32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
            keyed.push_back(
                {std::min(from, to), std::max(from, to), {static_cast<std::int32_t>(t), from < to}});
        }
    }
    std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.use.triangle < b.use.triangle;
    });
    m_uses.reserve(keyed.size());
    for (const Keyed& k : keyed) m_uses.push_back(k.use);
    for (std::size_t i = 0; i < keyed.size();) {
        std::size_t j = i;
        while (j < keyed.size() && keyed[j].low == keyed[i].low && keyed[j].high == keyed[i].high) ++j;
        const auto at = [&](std::size_t k) { return m_uses.cbegin() + static_cast<std::ptrdiff_t>(k); };
        m_edges.push_back({keyed[i].low, keyed[i].high, at(i), at(j)});
        i = j;
    }
}

}  // namespace windfall::geometry
