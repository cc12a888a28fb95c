#include "drying/flesh_cells.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <map>
#include <utility>

#include "core/parallel.h"
#include "drying/element.h"

namespace windfall::drying {

namespace {

using geometry::Vec3;

constexpr std::size_t kQuadBlock = 64;
constexpr std::size_t kBelow = 4, kAbove = 5;  // of a cell's faces; 0..3 are its sides

/// Area vector of a face whose corners lie in turn: exact for what is bilinear between them.
Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return 0.5 * (c - a).cross(d - b);
}

/// Edges of a hexahedron at its centre, along its three parent coordinates.
Eigen::Matrix3d middle_edges(const HexNodes& x) {
    Eigen::Matrix3d edges;
    edges << x[1] + x[2] + x[5] + x[6] - x[0] - x[3] - x[4] - x[7],
        x[2] + x[3] + x[6] + x[7] - x[0] - x[1] - x[4] - x[5],
        x[4] + x[5] + x[6] + x[7] - x[0] - x[1] - x[2] - x[3];
    return edges / 4;
}

std::array<std::array<int, 4>, 6> face_corners() {
    return {{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
}

double in_series(double a, double b) { return a * b / (a + b); }

}  // namespace

FleshCells::FleshCells(const geometry::LayeredMesh& mesh) : m_mesh(mesh) {
    const auto& quads = mesh.brick.quads;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> edge_at;
    m_neighbours.resize(quads.size());
    m_edges.resize(quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (std::size_t c = 0; c < 4; ++c) {
            const auto [low, high] = std::minmax(quads[q][c], quads[q][(c + 1) % 4]);
            const auto [at, is_new] =
                edge_at.try_emplace({low, high}, static_cast<std::int32_t>(m_edge_quads.size()));
            if (is_new) {
                m_edge_quads.push_back({static_cast<std::int32_t>(q), -1});
                m_edge_corners.push_back({static_cast<std::int32_t>(c), -1});
            } else {
                m_edge_quads[at->second][1] = static_cast<std::int32_t>(q);
                m_edge_corners[at->second][1] = static_cast<std::int32_t>(c);
            }
            m_edges[q][c] = at->second;
        }
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (std::size_t c = 0; c < 4; ++c) {
            const auto& both = m_edge_quads[m_edges[q][c]];
            m_neighbours[q][c] = both[0] == static_cast<std::int32_t>(q) ? both[1] : both[0];
        }

    m_volumes.resize(size());
    m_faces.resize(size());
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (std::size_t k = 0; k < layers(); ++k) {
            const std::size_t cell = q * layers() + k;
            const HexNodes nodes = element_nodes(mesh, q, static_cast<int>(k));
            m_volumes[cell] = hexahedron_volume(nodes);
            m_volume += m_volumes[cell];
            Vec3 centre = Vec3::Zero();
            for (const Vec3& node : nodes) centre += node / 8;
            for (std::size_t f = 0; f < 6; ++f) {
                const auto corners = face_corners()[f];
                const Vec3 area =
                    area_vector(nodes[corners[0]], nodes[corners[1]], nodes[corners[2]], nodes[corners[3]]);
                Vec3 middle = Vec3::Zero();
                for (const int corner : corners) middle += nodes[corner] / 4;
                m_faces[cell].areas[f] = area;
                m_faces[cell].reaches[f] = area.norm() * (middle - centre).norm();
            }
        }
}

FleshConductances FleshCells::conductances(const std::vector<Vec3>& nodes) const {
    geometry::LayeredMesh now = m_mesh;
    now.nodes = nodes;
    const std::size_t n = layers();
    // From a cell's centre to each of its faces, along the face's normal.
    std::vector<std::array<double, 6>> half(size());
    parallel_blocks(quads(), kQuadBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q)
            for (std::size_t k = 0; k < n; ++k) {
                const auto layer = static_cast<int>(k);
                const Eigen::Matrix3d to_fresh = middle_edges(element_nodes(m_mesh, q, layer)) *
                                                 middle_edges(element_nodes(now, q, layer)).inverse();
                const Faces& faces = m_faces[q * n + k];
                for (std::size_t f = 0; f < 6; ++f)
                    half[q * n + k][f] =
                        (to_fresh.transpose() * faces.areas[f]).squaredNorm() / faces.reaches[f];
            }
    });
    FleshConductances result;
    result.up.resize(size());
    result.side.resize(m_edge_quads.size() * n);
    for (std::size_t q = 0; q < quads(); ++q)
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t cell = q * n + k;
            result.up[cell] =
                k + 1 < n ? in_series(half[cell][kAbove], half[cell + 1][kBelow]) : half[cell][kAbove];
        }
    for (std::size_t e = 0; e < m_edge_quads.size(); ++e)
        for (std::size_t k = 0; k < n; ++k)
            result.side[e * n + k] = in_series(half[m_edge_quads[e][0] * n + k][m_edge_corners[e][0]],
                                               half[m_edge_quads[e][1] * n + k][m_edge_corners[e][1]]);
    return result;
}

std::vector<double> FleshCells::skin_areas(const std::vector<Vec3>& nodes) const {
    std::vector<double> areas(quads());
    for (std::size_t q = 0; q < areas.size(); ++q) {
        const auto& quad = m_mesh.brick.quads[q];
        const auto outer = [&](int c) -> const Vec3& { return nodes[(quad[c] + 1) * m_mesh.layers - 1]; };
        areas[q] = area_vector(outer(0), outer(1), outer(2), outer(3)).norm();
    }
    return areas;
}

}  // namespace windfall::drying
