#include "geometry/surface_check_finders.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "geometry/surface_check_crossings.h"
#include "geometry/surface_check_handles.h"

namespace windfall::geometry {

std::vector<std::vector<std::int32_t>> bodies_of(const Examination& e) {
    GrowingSets sets(e.surface.positions.size());
    for (const SurfaceEdge& edge : e.edges) sets.join(edge.low, edge.high);
    std::map<std::int32_t, std::vector<std::int32_t>> by_set;
    for (const std::int32_t t : e.all_triangles())
        by_set[sets.set_of(e.surface.triangles[t][0])].push_back(t);
    std::vector<std::pair<double, std::vector<std::int32_t>>> sized;
    for (auto& [set, triangles] : by_set) {
        double area = 0;
        for (const std::int32_t t : triangles) area += e.twice_area(t).norm();
        sized.emplace_back(area, std::move(triangles));
    }
    std::stable_sort(sized.begin(), sized.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<std::int32_t>> bodies;
    for (auto& [area, triangles] : sized) bodies.push_back(std::move(triangles));
    return bodies;
}

void find_bodies(Examination& e, const std::vector<std::vector<std::int32_t>>& bodies) {
    for (std::size_t i = 1; i < bodies.size(); ++i) {
        const Vec3 place = e.centre_of(bodies[i]);
        e.add(SurfaceDefectKind::SeveralBodies, place, bodies[i],
              fmt::format(
                  "a second body of {} triangles around {}: delete it or join it to the first (a stalk or "
                  "leaf belongs in a mesh of its own)",
                  bodies[i].size(), place_text(place)));
    }
}

void find_handles(Examination& e, std::size_t bodies) {
    const auto euler = static_cast<std::ptrdiff_t>(e.surface.positions.size() + e.surface.triangles.size()) -
                       static_cast<std::ptrdiff_t>(e.edges.size());
    const std::ptrdiff_t handles = (2 * static_cast<std::ptrdiff_t>(bodies) - euler) / 2;
    if (handles <= 0) return;
    std::vector<char> on_loop(e.surface.positions.size(), 0);
    Vec3 place = Vec3::Zero();
    const auto loop = handle_loop(e.edges, e.surface.positions.size(), e.surface.triangles.size());
    for (const std::int32_t v : loop) {
        on_loop[v] = 1;
        place += e.surface.positions[v] / static_cast<double>(loop.size());
    }
    std::vector<std::int32_t> around;
    for (const std::int32_t t : e.all_triangles()) {
        const auto& [a, b, c] = e.surface.triangles[t];
        if (on_loop[a] + on_loop[b] + on_loop[c] > 1) around.push_back(t);
    }
    e.add(SurfaceDefectKind::Handle, place, around,
          fmt::format("{} way{} through the body, one around {}, as in a ring: close it", handles,
                      handles == 1 ? "" : "s", place_text(place)));
}

void find_inside_out(Examination& e, const std::vector<std::int32_t>& body, const std::vector<char>& turned) {
    double six_volumes = 0;
    const Vec3& origin = e.surface.positions[0];
    for (const std::int32_t t : body)
        six_volumes += (turned[t] != 0 ? -1 : 1) * e.twice_area(t).dot(e.centre(t) - origin);
    if (six_volumes > 0) return;
    const Vec3 place = e.centre_of(body);
    e.add(SurfaceDefectKind::InsideOut, place, body,
          fmt::format("the body around {} is inside out: turn all its faces over", place_text(place)));
}

void find_self_intersections(Examination& e) {
    const auto crossings = self_crossings(e.surface);
    GrowingSets sets(e.surface.positions.size());
    for (const Crossing& crossing : crossings)
        for (const std::int32_t t : {crossing.first, crossing.second})
            for (const std::int32_t v : e.surface.triangles[t])
                sets.join(v, e.surface.triangles[crossing.first][0]);
    std::map<std::int32_t, std::pair<Vec3, std::vector<std::int32_t>>> pieces;
    for (const Crossing& crossing : crossings) {
        auto& [sum, triangles] = pieces
                                     .try_emplace(sets.set_of(e.surface.triangles[crossing.first][0]),
                                                  Vec3::Zero(), std::vector<std::int32_t>{})
                                     .first->second;
        sum += crossing.place;
        triangles.insert(triangles.end(), {crossing.first, crossing.second});
    }
    for (const auto& [set, piece] : pieces) {
        const std::size_t pairs = piece.second.size() / 2;
        const Vec3 place = piece.first / static_cast<double>(pairs);
        e.add(SurfaceDefectKind::SelfIntersection, place, piece.second,
              fmt::format(
                  "the surface passes through itself around {} ({} pair{} of triangles): pull the faces "
                  "apart or smooth them there",
                  place_text(place), pairs, pairs == 1 ? "" : "s"));
    }
}

}  // namespace windfall::geometry
