#include "geometry/surface_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "geometry/surface_check_finders.h"

namespace windfall::geometry {

namespace {

constexpr std::size_t kDefectsNamed = 5;

}  // namespace

std::string place_text(const Vec3& place_m) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", place_m.x(), place_m.y(), place_m.z());
}

std::vector<SurfaceDefect> surface_defects(const SurfaceMesh& mesh) {
    Examination e(mesh);
    if (e.surface.triangles.empty())
        return {{SurfaceDefectKind::Empty, Vec3::Zero(), {}, "there are no faces: export the mesh again"}};
    find_degenerate(e);
    find_holes(e);
    find_fins(e);
    const std::vector<char> turned = turned_over(e);
    find_flipped(e, turned);
    find_bow_ties(e);
    const auto bodies = bodies_of(e);
    find_bodies(e, bodies);
    // Genus and volume have a meaning only where every edge joins two faces.
    if (std::all_of(e.edges.begin(), e.edges.end(),
                    [](const SurfaceEdge& edge) { return edge.uses() == 2; })) {
        const auto is = [](SurfaceDefectKind kind) { return [=](const auto& d) { return d.kind == kind; }; };
        if (std::none_of(e.defects.begin(), e.defects.end(), is(SurfaceDefectKind::BowTie)))
            find_handles(e, bodies.size());
        find_inside_out(e, bodies[0], turned);
    }
    find_self_intersections(e);
    return std::move(e.defects);
}

void require_closed(const SurfaceMesh& mesh, const std::string& name) {
    const auto defects = surface_defects(mesh);
    if (defects.empty()) return;
    std::string text = fmt::format("{}: not the skin of one solid body:", name);
    for (std::size_t i = 0; i < std::min(defects.size(), kDefectsNamed); ++i)
        text += "\n  " + defects[i].text;
    if (defects.size() > kDefectsNamed)
        text += fmt::format("\n  and {} more", defects.size() - kDefectsNamed);
    throw InputError(text);
}

}  // namespace windfall::geometry
