#include "fracture/cracked_log.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "fracture/crack_shape.h"
#include "fracture/crack_walls.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

using geometry::Face;
using VertexIndex = std::int32_t;

constexpr double kRowOfWall = 0.12;  // radii: rows of faces on a crack's wall are about as high
constexpr double kPatch = 0.03;      // radii: size of the fibre bundles that colours vary between

/// The vertices of a layer of nodes: of a parted node that of its left side and that of its right.
struct LayerVertices {
    std::vector<VertexIndex> left, right;
};

class LogMaker {
  public:
    LogMaker(const FractureParameters& p, const CrackShape& shape, BranchMesh& mesh)
        : m_p(p),
          m_shape(shape),
          m_section(shape.section()),
          m_grid(shape.section().grid()),
          m_seed(noise_seed(p.seed)),
          m_bark_name(noise_key(m_seed, NoisePurpose::Bark, 2)),
          m_length(p.branch.length),
          m_mesh(mesh) {}

    void make() {
        reserve();
        add_upper_vertices();
        add_cut(m_upper, false);
        lay_out_rows();
        add_bark_vertices();
        add_bark();
        for (const LatticeCrack& crack : m_section.cracks()) add_crack(crack);
        add_lower_vertices();
        add_cut(m_lower, true);
    }

  private:
    void reserve() {
        const std::size_t cells = m_grid.node(m_grid.rings, 0);
        const std::size_t bark = static_cast<std::size_t>(m_grid.sectors * m_p.branch.layers);
        const std::size_t count = 2 * cells + bark + cells / 2;  // the last for the cracks
        m_mesh.positions.reserve(count);
        m_mesh.height.reserve(count);
        m_mesh.thorn.reserve(count);
        m_mesh.tissue.reserve(count);
        m_mesh.bundle.reserve(count);
        m_mesh.faces.reserve(count);
        m_mesh.parts.reserve(count);
        m_mesh.corner_uvs.reserve(count);
    }

    Tissue tissue_of(int ring) const {
        const TissueParameters& t = m_p.tissue;
        const double share = ring / static_cast<double>(m_grid.rings);
        if (ring >= m_grid.rings) return Tissue::Bark;
        if (ring > m_grid.wood_rings) return Tissue::Phloem;
        if (ring == 0 || share <= t.pith) return Tissue::Pith;
        return share <= t.pith + t.heartwood ? Tissue::Heartwood : Tissue::Sapwood;
    }

    std::uint32_t bundle_of(int ring, int sector) const {
        const double radius = ring / static_cast<double>(m_grid.rings);
        const auto band = static_cast<std::uint32_t>(radius / kPatch);
        const double around = std::max(1.0, std::floor(kTwoPi<double> * (band + 0.5)));
        const auto brick = static_cast<std::uint32_t>(sector * around / m_grid.sectors);
        return noise_key(m_seed, NoisePurpose::BundleName, band, brick, 63);
    }

    VertexIndex add_vertex(const Eigen::Vector2d& plan, double z, Tissue tissue, std::uint32_t bundle) {
        m_mesh.positions.emplace_back(static_cast<float>(plan.x()), static_cast<float>(plan.y()),
                                      static_cast<float>(z));
        m_mesh.height.push_back(m_mesh.positions.back().z());
        m_mesh.thorn.push_back(0);
        m_mesh.tissue.push_back(tissue);
        m_mesh.bundle.push_back(bundle);
        return static_cast<VertexIndex>(m_mesh.positions.size()) - 1;
    }

    /// Marks of the saw.
    double saw_mark(const Eigen::Vector2d& p) const {
        const auto x = static_cast<float>(p.x()), y = static_cast<float>(p.y());
        return 0.002 * gradient_noise(noise_key(m_seed, NoisePurpose::Crack, 0, 300), 30 * x, 30 * y) +
               0.003 * gradient_noise(noise_key(m_seed, NoisePurpose::Crack, 1, 300), 3 * x, 60 * y);
    }

    VertexIndex add_cut_vertex(const Eigen::Vector2d& node, double z, int r, int s) {
        return add_vertex(node, z + saw_mark(node), tissue_of(r), bundle_of(r, s));
    }

    void add_upper_vertices() {
        const CrackShape::Layer& nodes = m_shape.cut_face();
        m_upper.left.assign(static_cast<std::size_t>(m_grid.sectors), add_cut_vertex(nodes.left[0], 0, 0, 0));
        for (int r = 1; r <= m_grid.rings; ++r)
            for (int s = 0; s < m_grid.sectors; ++s)
                m_upper.left.push_back(add_cut_vertex(nodes.left[m_grid.node(r, s)], 0, r, s));
        m_upper.right = m_upper.left;
        for (int r = 1; r <= m_grid.rings; ++r)
            for (int s = 0; s < m_grid.sectors; ++s)
                if (m_section.owner(r, s) >= 0)
                    m_upper.right[m_grid.node(r, s)] =
                        add_cut_vertex(nodes.right[m_grid.node(r, s)], 0, r, s);
    }

    /// The lower cut has no cracks; its outermost nodes are the last row of the bark.
    void add_lower_vertices() {
        const CrackShape::Layer& nodes = m_shape.lower_end();
        m_lower.left.assign(static_cast<std::size_t>(m_grid.sectors),
                            add_cut_vertex(nodes.left[0], -m_length, 0, 0));
        for (int r = 1; r < m_grid.rings; ++r)
            for (int s = 0; s < m_grid.sectors; ++s)
                m_lower.left.push_back(add_cut_vertex(nodes.left[m_grid.node(r, s)], -m_length, r, s));
        const std::vector<VertexIndex>& rim = m_bark.back().left;
        m_lower.left.insert(m_lower.left.end(), rim.begin(), rim.end());
        m_lower.right = m_lower.left;
    }

    VertexIndex corner(const LayerVertices& layer, int r, int s, int cell_ring, int cell_sector) const {
        s = m_grid.wrapped_sector(s);
        const bool right = m_section.side_of_corner(r, s, cell_ring, cell_sector) == CrackSide::Right;
        return (right ? layer.right : layer.left)[m_grid.node(r, s)];
    }

    void add_cut(const LayerVertices& layer, bool downwards) {
        const auto uv = [&](VertexIndex v) {
            const Vector3f& p = m_mesh.positions[static_cast<std::size_t>(v)];
            return Vector2f(0.5F * p.x() + 0.5F, 0.5F * p.y() + 0.5F);
        };
        for (int r = 0; r < m_grid.rings; ++r)
            for (int s = 0; s < m_grid.sectors; ++s) {
                Face v{corner(layer, r, s, r, s), corner(layer, r + 1, s, r, s),
                       corner(layer, r + 1, s + 1, r, s), corner(layer, r, s + 1, r, s)};
                if (downwards) std::swap(v[1], v[3]);
                add_face(v, {uv(v[0]), uv(v[1]), uv(v[2]), uv(v[3])},
                         r < m_grid.wood_rings ? Part::EndGrain : Part::InnerBark, m_mesh);
            }
    }

    /// Rows of the bark: evenly down to the bottom of the check, where one is needed, and on to the lower
    /// cut.
    void lay_out_rows() {
        const auto layers = static_cast<int>(m_p.branch.layers);
        double check_depth = 0;
        for (const LatticeCrack& c : m_section.cracks())
            if (c.crack.reaches_bark()) check_depth = c.depth[c.entry(m_grid.rings)];
        if (check_depth > 0)
            m_check_rows =
                std::clamp(static_cast<int>(std::lround(layers * check_depth / m_length)), 1, layers - 1);
        for (int row = 0; row < m_check_rows; ++row) m_row_z.push_back(-check_depth * row / m_check_rows);
        const int left = layers - m_check_rows;
        for (int row = 0; row <= left; ++row)
            m_row_z.push_back(-check_depth - (m_length - check_depth) * row / left);
    }

    void add_bark_vertices() {
        m_bark.resize(m_row_z.size());
        for (std::size_t row = 0; row < m_row_z.size(); ++row)
            for (int s = 0; s < m_grid.sectors; ++s) {
                const std::size_t rim = m_grid.node(m_grid.rings, s);
                const auto add = [&](CrackSide side) {
                    return add_vertex(m_shape.at(m_grid.rings, s, m_row_z[row], side), m_row_z[row],
                                      Tissue::Bark, m_bark_name);
                };
                const bool parted =
                    m_section.owner(m_grid.rings, s) >= 0 && static_cast<int>(row) < m_check_rows;
                const VertexIndex left = row == 0 ? m_upper.left[rim] : add(CrackSide::Left);
                VertexIndex right = left;
                if (parted) right = row == 0 ? m_upper.right[rim] : add(CrackSide::Right);
                m_bark[row].left.push_back(left);
                m_bark[row].right.push_back(right);
            }
    }

    void add_bark() {
        const auto uv = [&](int s, VertexIndex v) {
            return Vector2f(static_cast<float>(s / static_cast<double>(m_grid.sectors)),
                            static_cast<float>(m_mesh.height[static_cast<std::size_t>(v)] / kTwoPi<double>));
        };
        for (int s = 0; s < m_grid.sectors; ++s) {
            const auto here = static_cast<std::size_t>(s),
                       next = static_cast<std::size_t>(m_grid.wrapped_sector(s + 1));
            for (std::size_t row = 0; row + 1 < m_row_z.size(); ++row) {
                const Face v{m_bark[row + 1].left[here], m_bark[row + 1].right[next], m_bark[row].right[next],
                             m_bark[row].left[here]};
                add_face(v, {uv(s, v[0]), uv(s + 1, v[1]), uv(s + 1, v[2]), uv(s, v[3])}, Part::Bark, m_mesh);
            }
        }
    }

    WallColumn wall_column(const LatticeCrack& c, int along, int rows) {
        const bool radial = c.crack.radial();
        const int ring = radial ? along : c.line, sector = radial ? c.line : m_grid.wrapped_sector(along);
        const std::size_t node = m_grid.node(ring, sector);
        const double step = radial ? 1.0 / m_grid.rings : c.crack.line * m_grid.sector_angle();
        WallColumn column{{m_upper.left[node]}, {m_upper.right[node]}, step * (along - c.begin)};
        if (along == c.begin || along == c.end) return column;
        for (int row = 1; row <= rows; ++row) {
            if (ring == m_grid.rings) {  // the check meets the bark
                const LayerVertices& bark = m_bark[static_cast<std::size_t>(row)];
                column.left.push_back(bark.left[static_cast<std::size_t>(sector)]);
                column.right.push_back(bark.right[static_cast<std::size_t>(sector)]);
                continue;
            }
            const double z = -c.depth[c.entry(along)] * row / rows;
            const auto add = [&](CrackSide side) {
                return add_vertex(m_shape.at(ring, sector, z, side), z, tissue_of(ring),
                                  bundle_of(ring, sector));
            };
            column.left.push_back(add(CrackSide::Left));
            column.right.push_back(row < rows ? add(CrackSide::Right) : column.left.back());
        }
        return column;
    }

    void add_crack(const LatticeCrack& c) {
        const double deepest = *std::max_element(c.depth.begin(), c.depth.end());
        const int rows = c.crack.reaches_bark()
                             ? m_check_rows
                             : std::clamp(static_cast<int>(std::lround(deepest / kRowOfWall)), 1, 12);
        WallColumn column = wall_column(c, c.begin, rows);
        for (int along = c.begin + 1; along <= c.last_node(); ++along) {
            WallColumn next = wall_column(c, along, rows);
            add_wall_faces(column, next, rows, true, m_mesh);
            column = std::move(next);
        }
    }

    const FractureParameters& m_p;
    const CrackShape& m_shape;
    const CrackedSection& m_section;
    const CrackGrid& m_grid;
    std::uint32_t m_seed, m_bark_name;
    double m_length;
    BranchMesh& m_mesh;
    std::vector<double> m_row_z;
    int m_check_rows = 0;
    LayerVertices m_upper, m_lower;     // by node
    std::vector<LayerVertices> m_bark;  // by row and sector
};

}  // namespace

CrackedLog make_cracked_log(const FractureParameters& parameters) {
    const CrackShape shape(parameters);
    CrackedLog log;
    log.cracks = shape.count();
    LogMaker(parameters, shape, log.mesh).make();
    return log;
}

}  // namespace windfall::fracture
