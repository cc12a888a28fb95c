#include "geometry/surface_check_finders.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace windfall::geometry {

namespace {

/// Smallest height of a triangle over its longest edge.
constexpr double kFlattest = 1e-7;

/// One defect for each connected group of the edges for which `bad` holds.
template <class Bad>
void find_edges(Examination& e, Bad bad, SurfaceDefectKind kind, const std::string& text) {
    GrowingSets sets(e.surface.positions.size());
    std::vector<std::int32_t> ends;
    for (const SurfaceEdge& edge : e.edges) {
        if (!bad(edge)) continue;
        sets.join(edge.low, edge.high);
        ends.push_back(edge.low);
    }
    struct Piece {
        int edges = 0;
        double length = 0;
        Vec3 sum = Vec3::Zero();
        std::vector<std::int32_t> triangles;
    };
    std::map<std::int32_t, Piece> pieces;
    for (const SurfaceEdge& edge : e.edges) {
        if (!bad(edge)) continue;
        Piece& piece = pieces[sets.set_of(edge.low)];
        const Vec3& a = e.surface.positions[edge.low];
        const Vec3& b = e.surface.positions[edge.high];
        ++piece.edges;
        piece.length += (b - a).norm();
        piece.sum += (b - a).norm() * (a + b) / 2;
        for (const EdgeUse& use : edge) piece.triangles.push_back(use.triangle);
    }
    for (const auto& [set, piece] : pieces) {
        const Vec3 place = piece.sum / piece.length;
        e.add(kind, place, piece.triangles,
              fmt::format(fmt::runtime(text), piece.edges, piece.edges == 1 ? "" : "s", place_text(place)));
    }
}

}  // namespace

void find_degenerate(Examination& e) {
    for (const std::int32_t t : e.all_triangles()) {
        const auto& [a, b, c] = e.surface.triangles[t];
        const auto& p = e.surface.positions;
        const double longest_sq =
            std::max({(p[b] - p[a]).squaredNorm(), (p[c] - p[b]).squaredNorm(), (p[a] - p[c]).squaredNorm()});
        if (e.twice_area(t).norm() > kFlattest * longest_sq) continue;
        const Vec3 place = e.centre(t);
        e.add(SurfaceDefectKind::Degenerate, place, {t},
              fmt::format("a face without area at {}: dissolve it", place_text(place)));
    }
}

void find_holes(Examination& e) {
    find_edges(
        e, [](const SurfaceEdge& edge) { return edge.uses() == 1; }, SurfaceDefectKind::Hole,
        "a hole of {} edge{} around {}: fill it");
}

void find_fins(Examination& e) {
    find_edges(
        e, [](const SurfaceEdge& edge) { return edge.uses() > 2; }, SurfaceDefectKind::Fin,
        "{} edge{} with more than two faces around {}: delete the faces that stand out or lie inside");
}

std::vector<char> turned_over(const Examination& e) {
    const std::size_t count = e.surface.triangles.size();
    std::vector<std::vector<std::pair<std::int32_t, bool>>> neighbours(count);
    for (const SurfaceEdge& edge : e.edges) {
        if (edge.uses() != 2) continue;
        const std::int32_t a = edge.first->triangle, b = (edge.first + 1)->triangle;
        neighbours[a].emplace_back(b, !edge.sound());
        neighbours[b].emplace_back(a, !edge.sound());
    }
    std::vector<char> turned(count, -1);
    std::vector<std::int32_t> patch;
    for (std::size_t start = 0; start < count; ++start) {
        if (turned[start] >= 0) continue;
        turned[start] = 0;
        patch.assign(1, static_cast<std::int32_t>(start));
        double balance = 0;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            const std::int32_t t = patch[i];
            balance += (turned[t] == 0 ? 1 : -1) * e.twice_area(t).norm();
            for (const auto& [next, turns] : neighbours[t]) {
                if (turned[next] >= 0) continue;
                turned[next] = static_cast<char>((turned[t] == 1) != turns);
                patch.push_back(next);
            }
        }
        if (balance < 0)
            for (const std::int32_t t : patch) turned[t] = static_cast<char>(1 - turned[t]);
    }
    return turned;
}

void find_flipped(Examination& e, const std::vector<char>& turned) {
    GrowingSets sets(turned.size());
    std::vector<std::int32_t> flipped;
    for (const std::int32_t t : e.all_triangles())
        if (turned[t] != 0) flipped.push_back(t);
    bool one_sided = false;
    for (const SurfaceEdge& edge : e.edges) {
        if (edge.uses() != 2) continue;
        const std::int32_t a = edge.first->triangle, b = (edge.first + 1)->triangle;
        if (turned[a] != 0 && turned[b] != 0) sets.join(a, b);
        if ((turned[a] != turned[b]) != edge.sound() || one_sided) continue;
        one_sided = true;
        const Vec3 place = (e.surface.positions[edge.low] + e.surface.positions[edge.high]) / 2;
        e.add(SurfaceDefectKind::FlippedFace, place, {a, b},
              fmt::format("a strip that has one side only, like Moebius's, passes through {}: cut it there",
                          place_text(place)));
    }
    for (const auto& [set, triangles] : sets.sets_of(flipped)) {
        const Vec3 place = e.centre_of(triangles);
        e.add(SurfaceDefectKind::FlippedFace, place, triangles,
              fmt::format("{} triangle{} wound against the rest around {}: turn the faces over (recalculate "
                          "normals)",
                          triangles.size(), triangles.size() == 1 ? "" : "s", place_text(place)));
    }
}

void find_bow_ties(Examination& e) {
    // Spokes 2 i and 2 i + 1 are the two edges of a triangle at its corner i % 3: a fan hangs together over
    // them.
    struct Spoke {
        std::int32_t vertex, other, number;
    };
    std::vector<Spoke> spokes;
    spokes.reserve(6 * e.surface.triangles.size());
    GrowingSets fans(6 * e.surface.triangles.size());
    for (const Triangle& v : e.surface.triangles)
        for (int k = 0; k < 3; ++k) {
            const auto number = static_cast<std::int32_t>(spokes.size());
            spokes.push_back({v[k], v[(k + 1) % 3], number});
            spokes.push_back({v[k], v[(k + 2) % 3], number + 1});
            fans.join(number, number + 1);
        }
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
        if (a.vertex != b.vertex) return a.vertex < b.vertex;
        return a.other != b.other ? a.other < b.other : a.number < b.number;
    });
    for (std::size_t i = 1; i < spokes.size(); ++i)
        if (spokes[i].vertex == spokes[i - 1].vertex && spokes[i].other == spokes[i - 1].other)
            fans.join(spokes[i].number, spokes[i - 1].number);
    for (std::size_t i = 0, j = 0; i < spokes.size(); i = j) {
        std::vector<std::int32_t> sets, around;
        for (; j < spokes.size() && spokes[j].vertex == spokes[i].vertex; ++j) {
            sets.push_back(fans.set_of(spokes[j].number));
            around.push_back(spokes[j].number / 6);
        }
        std::sort(sets.begin(), sets.end());
        const auto number = std::unique(sets.begin(), sets.end()) - sets.begin();
        if (number == 1) continue;
        const Vec3& place = e.surface.positions[spokes[i].vertex];
        e.add(SurfaceDefectKind::BowTie, place, around,
              fmt::format("{} fans of faces touch in the one vertex at {}: split it", number,
                          place_text(place)));
    }
}

}  // namespace windfall::geometry
