#include "fracture/bark_walls.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

using geometry::kNoVertex;

// Width of the hard rims between smooth parts, in radii.
constexpr float kRim = 0.015F;

/// One column of the wall: the rim's vertices at its node (the same one twice where the edge is not torn
/// there), before and behind it in angle.
struct RimNode {
    std::int32_t before, behind;
    float angle;
};

std::vector<RimNode> rim_nodes(const BreakEnds& ends) {
    const CellCorners& cells = ends.cells;
    std::vector<RimNode> nodes;
    nodes.reserve(static_cast<std::size_t>(cells.sectors));
    std::size_t next = 0;
    for (int s = 0; s < cells.sectors; ++s) {
        const std::int32_t before = cells.of(cells.rings - 1, s > 0 ? s - 1 : cells.sectors - 1)[2];
        const std::int32_t behind = cells.of(cells.rings - 1, s)[1];
        float angle = ends.rim[next].angle;
        if (before != behind) angle = 0.5F * (angle + ends.rim[++next].angle);
        ++next;
        nodes.push_back({before, behind, angle});
    }
    return nodes;
}

/// With some to spare, so that the next branch, which is a little larger, finds it too.
template <class Values>
void make_room(Values& values, std::size_t more) {
    const std::size_t needed = values.size() + more;
    if (values.capacity() < needed) values.reserve(needed + needed / 4);
}

/// The wall of one end. `direction` is -1 for the stub, whose wall goes down, and +1 for the piece.
class Wall {
  public:
    Wall(const FractureParameters& parameters, const std::vector<RimNode>& nodes, int direction,
         float far_end, BranchMesh& mesh)
        : m_nodes(nodes),
          m_rows(static_cast<std::size_t>(std::max<std::int64_t>(2, parameters.branch.layers))),
          m_cap_rings(static_cast<std::size_t>(std::clamp<std::int64_t>(parameters.branch.rings / 8, 2, 24))),
          m_direction(static_cast<float>(direction)),
          m_far(far_end),
          m_bundle(noise_key(noise_seed(parameters.seed), NoisePurpose::Bark, 2)),
          m_mesh(mesh) {}

    void add() {
        const std::size_t more = m_nodes.size() * (m_rows + m_cap_rings + 2);
        make_room(m_mesh.positions, more);
        make_room(m_mesh.height, more);
        make_room(m_mesh.thorn, more);
        make_room(m_mesh.tissue, more);
        make_room(m_mesh.bundle, more);
        make_room(m_mesh.faces, more);
        make_room(m_mesh.parts, more);
        make_room(m_mesh.corner_uvs, more);
        add_vertices();
        add_bark();
        add_rim();
        add_cap();
    }

  private:
    std::int32_t vertex(float x, float y, float z, Tissue tissue) {
        m_mesh.positions.emplace_back(x, y, z);
        m_mesh.height.push_back(z);
        m_mesh.thorn.push_back(0);
        m_mesh.tissue.push_back(tissue);
        m_mesh.bundle.push_back(m_bundle);
        return static_cast<std::int32_t>(m_mesh.positions.size()) - 1;
    }
    float z_of(std::int32_t v) const { return m_mesh.positions[static_cast<std::size_t>(v)].z(); }

    /// Columns by sector, rows from the far end to just short of the broken edge.
    void add_vertices() {
        m_first = static_cast<std::int32_t>(m_mesh.positions.size());
        for (const RimNode& node : m_nodes) {
            const float c = std::cos(node.angle), s = std::sin(node.angle);
            const float before = z_of(node.before), behind = z_of(node.behind);
            const float edge =
                (m_direction < 0 ? std::min(before, behind) : std::max(before, behind)) + m_direction * kRim;
            for (std::size_t row = 0; row < m_rows; ++row) {
                const float left = 1 - static_cast<float>(row) / static_cast<float>(m_rows - 1);
                vertex(c, s, edge + (m_far - edge) * left * left, Tissue::Bark);
            }
        }
    }
    std::int32_t at(std::size_t column, std::size_t row) const {
        return m_first + static_cast<std::int32_t>((column % m_nodes.size()) * m_rows + row);
    }

    /// Bark: a turn is one unit of u, and 2 pi radii one unit of v, so that textures keep their proportions.
    Vector2f bark_uv(std::size_t column, float z) const {
        const float turn = column < m_nodes.size() ? m_nodes[column].angle : m_nodes[0].angle + kTwoPi<float>;
        return {turn / kTwoPi<float>, z / kTwoPi<float>};
    }

    /// Corners counter-clockwise from outside on the stub; the piece's wall is its mirror image.
    void face(std::array<std::int32_t, 4> v, std::array<Vector2f, 4> uv, Part part) {
        if (m_direction > 0) {
            const std::ptrdiff_t count = v[3] == kNoVertex ? 3 : 4;
            std::reverse(v.begin(), v.begin() + count);
            std::reverse(uv.begin(), uv.begin() + count);
        }
        m_mesh.faces.push_back(v);
        m_mesh.corner_uvs.push_back(uv);
        m_mesh.parts.push_back(part);
    }

    void add_bark() {
        for (std::size_t s = 0; s < m_nodes.size(); ++s)
            for (std::size_t row = 0; row + 1 < m_rows; ++row) {
                const std::array<std::int32_t, 4> v{at(s, row), at(s + 1, row), at(s + 1, row + 1),
                                                    at(s, row + 1)};
                face(v,
                     {bark_uv(s, z_of(v[0])), bark_uv(s + 1, z_of(v[1])), bark_uv(s + 1, z_of(v[2])),
                      bark_uv(s, z_of(v[3]))},
                     Part::Bark);
            }
    }

    /// From the last row to the torn edge.
    void add_rim() {
        const std::size_t last = m_rows - 1;
        for (std::size_t s = 0; s < m_nodes.size(); ++s) {
            const RimNode& node = m_nodes[s];
            const RimNode& next = m_nodes[(s + 1) % m_nodes.size()];
            const std::array<std::int32_t, 4> v{at(s, last), at(s + 1, last), next.before, node.behind};
            face(v,
                 {bark_uv(s, z_of(v[0])), bark_uv(s + 1, z_of(v[1])), bark_uv(s + 1, z_of(v[2])),
                  bark_uv(s, z_of(v[3]))},
                 Part::InnerBark);
            if (node.before == node.behind) continue;
            face({at(s, last), node.behind, node.before, kNoVertex},
                 {bark_uv(s, z_of(at(s, last))), bark_uv(s, z_of(node.behind)), bark_uv(s, z_of(node.before)),
                  Vector2f::Zero()},
                 Part::InnerBark);
        }
    }

    /// The cut at the far end: a hard rim, then rings of end grain down to the pith.
    void add_cap() {
        const auto start = static_cast<std::int32_t>(m_mesh.positions.size());
        for (std::size_t ring = 0; ring < m_cap_rings; ++ring) {
            const float radius =
                (1 - kRim) * (1 - static_cast<float>(ring) / static_cast<float>(m_cap_rings));
            for (const RimNode& node : m_nodes)
                vertex(radius * std::cos(node.angle), radius * std::sin(node.angle), m_far, Tissue::Sapwood);
        }
        const std::int32_t pith = vertex(0, 0, m_far, Tissue::Pith);
        const auto cap = [&](std::size_t ring, std::size_t s) {
            return start + static_cast<std::int32_t>(ring * m_nodes.size() + s % m_nodes.size());
        };
        const auto uv = [&](std::int32_t v) {
            const Vector3f& p = m_mesh.positions[static_cast<std::size_t>(v)];
            return Vector2f(0.5F * p.x() + 0.5F, 0.5F * p.y() + 0.5F);
        };
        for (std::size_t s = 0; s < m_nodes.size(); ++s) {
            face({at(s + 1, 0), at(s, 0), cap(0, s), cap(0, s + 1)},
                 {uv(at(s + 1, 0)), uv(at(s, 0)), uv(cap(0, s)), uv(cap(0, s + 1))}, Part::InnerBark);
            for (std::size_t ring = 0; ring + 1 < m_cap_rings; ++ring)
                face({cap(ring, s + 1), cap(ring, s), cap(ring + 1, s), cap(ring + 1, s + 1)},
                     {uv(cap(ring, s + 1)), uv(cap(ring, s)), uv(cap(ring + 1, s)), uv(cap(ring + 1, s + 1))},
                     Part::EndGrain);
            const std::size_t inner = m_cap_rings - 1;
            face({cap(inner, s + 1), cap(inner, s), pith, kNoVertex},
                 {uv(cap(inner, s + 1)), uv(cap(inner, s)), uv(pith), Vector2f::Zero()}, Part::EndGrain);
        }
    }

    const std::vector<RimNode>& m_nodes;
    std::size_t m_rows, m_cap_rings;
    float m_direction, m_far;
    std::uint32_t m_bundle;
    BranchMesh& m_mesh;
    std::int32_t m_first = 0;
};

}  // namespace

void add_bark_walls(const FractureParameters& parameters, BreakEnds& ends) {
    const std::vector<RimNode> nodes = rim_nodes(ends);
    const auto low = static_cast<float>(ends.lowest - kRim - parameters.branch.length);
    const auto high = static_cast<float>(ends.highest + kRim + parameters.branch.piece_length);
    Wall(parameters, nodes, -1, low, ends.stub).add();
    Wall(parameters, nodes, 1, high, ends.piece).add();
}

}  // namespace windfall::fracture
