#include "decay/tetrahedra.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "geometry/layered_mesh.h"

namespace windfall::decay {

namespace {

using geometry::Vec3;

/// Where the innermost layer stands between the centre (0) and the surface (1): the tetrahedra around the
/// centre would become needles nearer to it.
constexpr double kInnermostLayer = 0.22;

double layer_fraction(int layer, int layers) {
    const double a = static_cast<double>(layer) / (layers - 1);
    return 1 - (1 - kInnermostLayer) * (0.55 * a + 0.45 * a * a);
}

/// Triangles of the surface; diagonals alternate like a chess board, so that no direction is stiffer.
std::vector<std::array<std::int32_t, 3>> surface_triangles(const geometry::BrickSurface& brick) {
    std::vector<std::array<std::int32_t, 3>> triangles;
    triangles.reserve(2 * brick.quads.size());
    for (const auto& q : brick.quads) {
        const auto& p = brick.lattice[q[0]];
        if ((p[0] + p[1] + p[2]) % 2 == 0) {
            triangles.push_back({q[0], q[1], q[2]});
            triangles.push_back({q[0], q[2], q[3]});
        } else {
            triangles.push_back({q[1], q[2], q[3]});
            triangles.push_back({q[1], q[3], q[0]});
        }
    }
    return triangles;
}

/// Cuts the prism between a triangle and the one `inwards` further on. Neighbours agree on the diagonals of
/// the sides, because each starts at the vertex with the smaller index.
void cut_prism(std::array<std::int32_t, 3> top, std::int32_t inwards, std::vector<Tetrahedron>& out) {
    bool even = true;
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 1}}) {
        if (top[i] < top[j]) continue;
        std::swap(top[i], top[j]);
        even = !even;
    }
    const auto [a, b, c] = top;
    for (Tetrahedron t : {Tetrahedron{a, b, c, c + inwards}, Tetrahedron{a, b, c + inwards, b + inwards},
                          Tetrahedron{a, a + inwards, b + inwards, c + inwards}}) {
        if (even) std::swap(t[1], t[2]);
        out.push_back(t);
    }
}

void check_orientation(const FleshMesh& mesh) {
    double sum = 0;
    for (const Tetrahedron& t : mesh.tetrahedra)
        sum += six_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]);
    const double smallest = 1e-5 * sum / static_cast<double>(mesh.tetrahedra.size());
    for (const Tetrahedron& t : mesh.tetrahedra) {
        const Vec3& a = mesh.nodes[t[0]];
        if (six_volume(a, mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]) > smallest && smallest > 0)
            continue;
        throw InputError(fmt::format(
            "the inside of the fruit folds over near ({:.1f}, {:.1f}, {:.1f}) mm: its surface does "
            "not see the centre from there; smooth the shape or give an interior",
            1e3 * a.x(), 1e3 * a.y(), 1e3 * a.z()));
    }
}

}  // namespace

double six_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
}

FleshMesh make_flesh_mesh(const SurfaceFunction& surface, const InteriorFunction& interior, int cells,
                          int layers) {
    if (cells < 2 || layers < 2)
        throw InputError(fmt::format("flesh of {} cells and {} layers; both must be >= 2", cells, layers));
    FleshMesh mesh;
    mesh.brick = geometry::make_brick_surface({cells, cells, cells});
    mesh.layers = layers;
    const auto directions = geometry::brick_directions(mesh.brick, Vec3::Ones());
    const auto columns = static_cast<std::int32_t>(directions.size());
    mesh.nodes.reserve(static_cast<std::size_t>(columns) * layers + 1);
    for (const Vec3& d : directions) mesh.nodes.push_back(surface(d));
    for (int layer = 1; layer < layers; ++layer)
        for (const Vec3& d : directions) mesh.nodes.push_back(interior(d, layer_fraction(layer, layers)));
    const auto centre = static_cast<std::int32_t>(mesh.nodes.size());
    mesh.nodes.push_back(interior(directions[0], 0));

    const auto triangles = surface_triangles(mesh.brick);
    for (int layer = 0; layer + 1 < layers; ++layer)
        for (auto t : triangles) {
            for (auto& v : t) v += layer * columns;
            cut_prism(t, columns, mesh.tetrahedra);
        }
    const std::int32_t innermost = (layers - 1) * columns;
    for (const auto& t : triangles)
        mesh.tetrahedra.push_back({t[0] + innermost, t[2] + innermost, t[1] + innermost, centre});
    check_orientation(mesh);
    return mesh;
}

std::vector<std::array<std::int32_t, 2>> edges_of(const std::vector<Tetrahedron>& tetrahedra) {
    std::vector<std::array<std::int32_t, 2>> edges;
    edges.reserve(6 * tetrahedra.size());
    for (const Tetrahedron& t : tetrahedra)
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) edges.push_back({std::min(t[i], t[j]), std::max(t[i], t[j])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

InteriorFunction towards_centre(const SurfaceFunction& surface, const Vec3& centre) {
    return [surface, centre](const Vec3& direction, double fraction) -> Vec3 {
        return centre + fraction * (surface(direction) - centre);
    };
}

}  // namespace windfall::decay
