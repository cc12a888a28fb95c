// Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes" (1978),
// doi:10.1016/0010-4485(78)90110-0; limit positions: Halstead, Kass, DeRose (1993),
// doi:10.1145/166117.166121.
#include "picture/refinement.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace windfall::picture {
namespace {

using Triplet = Eigen::Triplet<float>;
using Matrix = Eigen::SparseMatrix<float, Eigen::RowMajor>;
using Polygon = std::vector<std::uint32_t>;

struct Edge {
    std::uint32_t a = 0, b = 0;  // a < b
    std::vector<std::uint32_t> faces;
    bool inner() const { return faces.size() == 2; }
};

/// Edges of a mesh, and which edge starts at each corner of each face.
struct Topology {
    std::vector<Edge> edges;
    std::vector<std::vector<std::uint32_t>> face_edges;
};

Topology topology_of(const std::vector<Polygon>& faces) {
    struct Side {
        std::uint32_t a, b, face, corner;
    };
    std::vector<Side> sides;
    Topology result;
    result.face_edges.resize(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto n = static_cast<std::uint32_t>(faces[f].size());
        result.face_edges[f].resize(n);
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t u = faces[f][k], v = faces[f][(k + 1) % n];
            sides.push_back({std::min(u, v), std::max(u, v), f, k});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
        return std::tie(s.a, s.b, s.face, s.corner) < std::tie(t.a, t.b, t.face, t.corner);
    });
    for (const Side& side : sides) {
        if (result.edges.empty() || result.edges.back().a != side.a || result.edges.back().b != side.b)
            result.edges.push_back({side.a, side.b, {}});
        result.edges.back().faces.push_back(side.face);
        result.face_edges[side.face][side.corner] = static_cast<std::uint32_t>(result.edges.size() - 1);
    }
    return result;
}

/// What a vertex needs to know of its neighbours.
struct Star {
    std::vector<std::uint32_t> edges, faces;
    bool on_boundary = false;
};

std::vector<Star> stars_of(const std::vector<Polygon>& faces, const Topology& topology,
                           std::size_t vertex_count) {
    std::vector<Star> stars(vertex_count);
    for (std::uint32_t e = 0; e < topology.edges.size(); ++e)
        for (const std::uint32_t v : {topology.edges[e].a, topology.edges[e].b}) {
            stars[v].edges.push_back(e);
            stars[v].on_boundary |= !topology.edges[e].inner();
        }
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t v : faces[f]) stars[v].faces.push_back(f);
    return stars;
}

std::uint32_t other_end(const Edge& edge, std::uint32_t v) { return edge.a == v ? edge.b : edge.a; }

/// Weights of the boundary curve: `centre` for the vertex itself, the rest for its two neighbours along the
/// boundary.
void boundary_row(std::vector<Triplet>& weights, const Topology& topology, const Star& star, std::uint32_t v,
                  float centre) {
    std::vector<std::uint32_t> ends;
    for (const std::uint32_t e : star.edges)
        if (!topology.edges[e].inner()) ends.push_back(other_end(topology.edges[e], v));
    const int row = static_cast<int>(v);
    if (ends.size() !=
        2) {  // a corner where several boundaries meet, or a vertex without faces, stays in place
        weights.emplace_back(row, row, 1.0F);
        return;
    }
    weights.emplace_back(row, row, centre);
    for (const std::uint32_t end : ends) weights.emplace_back(row, static_cast<int>(end), (1 - centre) / 2);
}

Matrix matrix_of(std::size_t rows, std::size_t columns, const std::vector<Triplet>& weights) {
    Matrix matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    matrix.setFromTriplets(weights.begin(), weights.end());
    return matrix;
}

/// New vertices: the old ones, then one per edge, then one per face.
Matrix subdivision_step(const std::vector<Polygon>& faces, const Topology& topology,
                        std::size_t vertex_count) {
    const std::size_t edge_count = topology.edges.size();
    std::vector<Triplet> weights;
    const auto add_face_point = [&](int row, std::uint32_t f, float weight) {
        for (const std::uint32_t v : faces[f])
            weights.emplace_back(row, static_cast<int>(v), weight / static_cast<float>(faces[f].size()));
    };
    const auto stars = stars_of(faces, topology, vertex_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        const Star& star = stars[v];
        if (star.on_boundary || star.faces.empty()) {
            boundary_row(weights, topology, star, v, 0.75F);
            continue;
        }
        // (mean of face points + 2 mean of edge midpoints + (n - 3) v) / n
        const auto n = static_cast<float>(star.edges.size());
        const int row = static_cast<int>(v);
        weights.emplace_back(row, row, (n - 3) / n + 1 / n);
        for (const std::uint32_t e : star.edges)
            weights.emplace_back(row, static_cast<int>(other_end(topology.edges[e], v)), 1 / (n * n));
        for (const std::uint32_t f : star.faces)
            add_face_point(row, f, 1 / (n * static_cast<float>(star.faces.size())));
    }
    for (std::uint32_t e = 0; e < edge_count; ++e) {
        const Edge& edge = topology.edges[e];
        const int row = static_cast<int>(vertex_count + e);
        const float ends = edge.inner() ? 0.25F : 0.5F;
        weights.emplace_back(row, static_cast<int>(edge.a), ends);
        weights.emplace_back(row, static_cast<int>(edge.b), ends);
        if (edge.inner())
            for (const std::uint32_t f : edge.faces) add_face_point(row, f, 0.25F);
    }
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        add_face_point(static_cast<int>(vertex_count + edge_count + f), f, 1);
    return matrix_of(vertex_count + edge_count + faces.size(), vertex_count, weights);
}

std::vector<Polygon> split(const std::vector<Polygon>& faces, const Topology& topology,
                           std::size_t vertex_count) {
    std::vector<Polygon> result;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::size_t n = faces[f].size();
        const auto face_vertex = static_cast<std::uint32_t>(vertex_count + topology.edges.size() + f);
        for (std::size_t k = 0; k < n; ++k) {
            const auto edge_vertex = [&](std::size_t corner) {
                return static_cast<std::uint32_t>(vertex_count + topology.face_edges[f][corner]);
            };
            result.push_back({faces[f][k], edge_vertex(k), face_vertex, edge_vertex((k + n - 1) % n)});
        }
    }
    return result;
}

/// To the limit surface, where all faces have four corners: (n^2 v + 4 sum of edge neighbours + sum of face
/// diagonals) / (n (n + 5)).
Matrix limit_step(const std::vector<Polygon>& faces, const Topology& topology, std::size_t vertex_count) {
    std::vector<Triplet> weights;
    const auto stars = stars_of(faces, topology, vertex_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        const Star& star = stars[v];
        if (star.on_boundary || star.faces.empty()) {
            boundary_row(weights, topology, star, v, 2 / 3.0F);
            continue;
        }
        const auto n = static_cast<float>(star.edges.size());
        const float whole = n * (n + 5);
        const int row = static_cast<int>(v);
        weights.emplace_back(row, row, n * n / whole);
        for (const std::uint32_t e : star.edges)
            weights.emplace_back(row, static_cast<int>(other_end(topology.edges[e], v)), 4 / whole);
        for (const std::uint32_t f : star.faces) {
            const auto at = std::find(faces[f].begin(), faces[f].end(), v) - faces[f].begin();
            weights.emplace_back(row, static_cast<int>(faces[f][static_cast<std::size_t>((at + 2) % 4)]),
                                 1 / whole);
        }
    }
    return matrix_of(vertex_count, vertex_count, weights);
}

}  // namespace

Refinement::Refinement(const std::vector<geometry::Face>& faces, std::size_t vertex_count, int levels) {
    std::vector<Polygon> polygons;
    for (const auto& face : faces) {
        Polygon polygon;
        for (int k = 0; k < geometry::corner_count(face); ++k) {
            const std::int32_t v = face[static_cast<std::size_t>(k)];
            if (v < 0 || static_cast<std::size_t>(v) >= vertex_count)
                throw InputError(
                    fmt::format("a face names vertex {} of a mesh with {} vertices", v, vertex_count));
            polygon.push_back(static_cast<std::uint32_t>(v));
        }
        polygons.push_back(std::move(polygon));
    }
    for (int level = 0; level < levels; ++level) {
        const Topology topology = topology_of(polygons);
        m_steps.push_back(subdivision_step(polygons, topology, vertex_count));
        polygons = split(polygons, topology, vertex_count);
        vertex_count = static_cast<std::size_t>(m_steps.back().rows());
    }
    m_steps.push_back(limit_step(polygons, topology_of(polygons), vertex_count));
    for (const Polygon& p : polygons) m_quads.push_back({p[0], p[1], p[2], p[3]});
}

std::size_t Refinement::vertex_count() const { return static_cast<std::size_t>(m_steps.back().rows()); }

Channels Refinement::apply(const Channels& coarse) const {
    Channels values = coarse;
    for (const Matrix& step : m_steps) values = Channels(step * values);
    return values;
}

std::vector<std::array<Eigen::Vector2f, 4>> refined_corners(
    const std::vector<geometry::Face>& faces, const std::vector<std::array<geometry::Vec2, 4>>& corner_uvs,
    int levels) {
    using Corners = std::array<Eigen::Vector2f, 4>;
    // in the order of `split`: for each corner it, the middle of the edge behind it, the middle of the face,
    // the middle of the edge before it
    const auto append_parts = [](const Corners& corners, std::size_t n, std::vector<Corners>& parts) {
        Eigen::Vector2f middle = Eigen::Vector2f::Zero();
        for (std::size_t k = 0; k < n; ++k) middle += corners[k] / static_cast<float>(n);
        for (std::size_t k = 0; k < n; ++k)
            parts.push_back({corners[k], (corners[k] + corners[(k + 1) % n]) / 2, middle,
                             (corners[k] + corners[(k + n - 1) % n]) / 2});
    };
    std::vector<Corners> quads;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = corner_uvs[f][k].cast<float>();
        append_parts(corners, static_cast<std::size_t>(geometry::corner_count(faces[f])), quads);
    }
    for (int level = 1; level < levels; ++level) {
        std::vector<Corners> parts;
        parts.reserve(4 * quads.size());
        for (const Corners& corners : quads) append_parts(corners, 4, parts);
        quads = std::move(parts);
    }
    return quads;
}

std::vector<Vec3f> smooth_normals(const std::vector<Vec3f>& positions,
                                  const std::vector<std::array<std::uint32_t, 4>>& quads) {
    std::vector<Vec3f> normals(positions.size(), Vec3f::Zero());
    for (const auto& q : quads) {
        const Vec3f area = facet_area(positions, q);
        for (const std::uint32_t v : q) normals[v] += area;
    }
    for (Vec3f& n : normals) {
        const float length = n.norm();
        n = length > 0 ? Vec3f(n / length) : Vec3f::UnitY();
    }
    return normals;
}

}  // namespace windfall::picture
