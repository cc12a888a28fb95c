// The surface that both ends share. A node of the lattice becomes one vertex for each run of equally named
// cells around it; the vertices of a node stand apart by a fraction of a cell, walls between them go along
// the grain, and where three or more runs meet a small polygon closes the node. The surface is a graph over
// the cross-section, so that the other end, its reverse, fits it without overlap.
#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "fracture/break_buffers.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

using geometry::Face;
using geometry::kNoVertex;

// How far split vertices move into their own cells, in cells. With the jitter of the nodes (0.10) it stays
// well below a quarter, so that no cell can turn inside out.
constexpr float kSplitShift = 0.08F;
// The same across the rays, at most, in distances between rings: wide cells are bent as their arcs are.
constexpr float kMostShift = 0.25F;

/// Angle by which split vertices of ring `r` move.
float split_turn(const PolarLattice& lattice, int r) {
    return std::min(kSplitShift * kTwoPi<float> / static_cast<float>(lattice.sectors),
                    kMostShift / static_cast<float>(r));
}

class VertexMaker {
  public:
    VertexMaker(BreakWorkspace::Buffers& b, BreakEnds& ends)
        : m_b(b), m_v(b.vertices), m_corners(ends.cells.corners), m_rim(ends.rim) {}

    void make() {
        const PolarLattice& lattice = m_b.lattice;
        make_room();
        m_corners.resize(lattice.cells());
        m_rim.clear();
        const std::int32_t pith = add(0, particle(0, 0), 0, 0);
        for (std::size_t s = 0; s < static_cast<std::size_t>(lattice.sectors); ++s)
            m_corners[s][0] = m_corners[s][3] = pith;
        for (int r = 1; r < lattice.rings; ++r) {
            make_room();
            for (int s = 0; s < lattice.sectors; ++s) split_node(r, s);
        }
        make_room();
        for (int s = 0; s < lattice.sectors; ++s) split_rim_node(s);
        resize(m_count);
    }

  private:
    /// Room for every node of a ring to split in four; what is not used is cut off at the end.
    void resize(std::size_t count) {
        m_v.x.resize(count);
        m_v.y.resize(count);
        m_v.z.resize(count);
        m_v.thorn.resize(count);
        m_v.name.resize(count);
        m_v.particle.resize(count);
        m_v.tissue.resize(count);
    }
    void make_room() {
        const std::size_t needed = m_count + 4 * static_cast<std::size_t>(m_b.lattice.sectors);
        if (needed > m_v.x.size()) resize(needed + needed / 4);
    }

    static std::uint32_t particle(int r, int s) {
        return static_cast<std::uint32_t>(r) << 16U | static_cast<std::uint32_t>(s);
    }

    std::int32_t add(std::size_t c, std::uint32_t particle, float x, float y) {
        const BreakCells& cells = m_b.cells;
        const std::size_t i = m_count++;
        m_v.x[i] = x;
        m_v.y[i] = y;
        m_v.z[i] = cells.height[c] + cells.slope_x[c] * x + cells.slope_y[c] * y;
        m_v.thorn[i] = cells.thorn[c];
        m_v.name[i] = cells.name[c];
        m_v.particle[i] = particle;
        m_v.tissue[i] = cells.tissue[c];
        return static_cast<std::int32_t>(i);
    }

    /// The node (r, s), 0 < r < rings. Around it, counter-clockwise seen in (angle, radius): the cells at
    /// (r-1, s-1), (r, s-1), (r, s), (r-1, s); it is their corner 2, 3, 0, 1.
    void split_node(int r, int s) {
        const PolarLattice& lattice = m_b.lattice;
        const int before = s > 0 ? s - 1 : lattice.sectors - 1;
        const std::array<std::size_t, 4> cell{lattice.cell(r - 1, before), lattice.cell(r, before),
                                              lattice.cell(r, s), lattice.cell(r - 1, s)};
        const std::uint32_t* name = m_b.cells.name.data();
        const std::array<std::uint32_t, 4> names{name[cell[0]], name[cell[1]], name[cell[2]], name[cell[3]]};
        const std::size_t node = lattice.cell(r, s);
        const float x = lattice.node_x[node], y = lattice.node_y[node];
        if (names[0] == names[1] && names[1] == names[2] && names[2] == names[3]) {
            const std::int32_t v = add(cell[0], particle(r, s), x, y);
            m_corners[cell[0]][2] = m_corners[cell[1]][3] = m_corners[cell[2]][0] = m_corners[cell[3]][1] = v;
            return;
        }
        // Unit steps of 1 cell: outwards (radially), and around.
        const float inverse = 1 / static_cast<float>(r);
        const float out_x = x * inverse * kSplitShift, out_y = y * inverse * kSplitShift;
        const float turn = split_turn(lattice, r);
        const float around_x = -y * turn, around_y = x * turn;
        static constexpr std::array<float, 4> kOut{-1, 1, 1, -1}, kAround{-1, -1, 1, 1};
        static constexpr std::array<std::size_t, 4> kCorner{2, 3, 0, 1};

        std::size_t start = 0;
        while (names[start] == names[(start + 3) & 3U]) ++start;
        for (std::size_t done = 0; done < 4;) {
            const std::size_t first = start + done;
            float out = 0, around = 0;
            std::size_t length = 0;
            do {
                out += kOut[(first + length) & 3U];
                around += kAround[(first + length) & 3U];
                ++length;
            } while (done + length < 4 && names[(first + length) & 3U] == names[first & 3U]);
            const float share = 1 / static_cast<float>(length);
            const std::int32_t v =
                add(cell[first & 3U], particle(r, s), x + share * (out * out_x + around * around_x),
                    y + share * (out * out_y + around * around_y));
            for (std::size_t k = first; k < first + length; ++k) m_corners[cell[k & 3U]][kCorner[k & 3U]] = v;
            done += length;
        }
    }

    void split_rim_node(int s) {
        const PolarLattice& lattice = m_b.lattice;
        const int r = lattice.rings - 1;
        const std::size_t before = lattice.cell(r, s > 0 ? s - 1 : lattice.sectors - 1);
        const std::size_t behind = lattice.cell(r, s);
        const std::size_t node = lattice.cell(lattice.rings, s);
        const float x = lattice.node_x[node], y = lattice.node_y[node];
        const float angle = lattice.rim_angle[static_cast<std::size_t>(s)];
        if (m_b.cells.name[before] == m_b.cells.name[behind]) {
            const std::int32_t v = add(behind, particle(lattice.rings, s), x, y);
            m_corners[before][2] = m_corners[behind][1] = v;
            m_rim.push_back({v, angle});
            return;
        }
        const float turn = split_turn(lattice, lattice.rings);
        const float c = 1 - 0.5F * turn * turn;
        const std::int32_t a = add(before, particle(lattice.rings, s), c * x + turn * y, c * y - turn * x);
        const std::int32_t b = add(behind, particle(lattice.rings, s), c * x - turn * y, c * y + turn * x);
        m_corners[before][2] = a;
        m_corners[behind][1] = b;
        m_rim.push_back({a, angle - turn});
        m_rim.push_back({b, angle + turn});
    }

    BreakWorkspace::Buffers& m_b;
    SurfaceVertices& m_v;
    std::vector<std::array<std::int32_t, 4>>& m_corners;
    std::vector<RimVertex>& m_rim;
    std::size_t m_count = 0;
};

/// z += lambda (Perlin octaves) + lambda (white octaves), with the tissue's lambda and beta (eq. 1).
void add_roughness(const FractureParameters& parameters, BreakWorkspace::Buffers& b) {
    const RoughnessParameters& p = parameters.roughness;
    const std::uint32_t seed = noise_seed(parameters.seed);
    const auto radius_m = static_cast<float>(0.5 * parameters.branch.diameter_m);
    // Pith takes the heartwood's values: Table 2 has none for it.
    const std::array<float, 4> lambda{static_cast<float>(p.heartwood), static_cast<float>(p.heartwood),
                                      static_cast<float>(p.sapwood), static_cast<float>(p.phloem)};
    const std::array<float, 4> beta{static_cast<float>(p.heartwood_frequency) * radius_m,
                                    static_cast<float>(p.heartwood_frequency) * radius_m,
                                    static_cast<float>(p.sapwood_frequency) * radius_m,
                                    static_cast<float>(p.phloem_frequency) * radius_m};
    if (*std::max_element(lambda.begin(), lambda.end()) <= 0) return;
    SurfaceVertices& v = b.vertices;
    const std::size_t count = v.x.size();
    b.amplitude.resize(count);
    b.frequency.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto tissue = static_cast<std::size_t>(v.tissue[i]);
        b.amplitude[i] = lambda[tissue];
        b.frequency[i] = beta[tissue];
    }
    const float* __restrict x = v.x.data();
    const float* __restrict y = v.y.data();
    const float* __restrict amplitude = b.amplitude.data();
    const float* __restrict frequency = b.frequency.data();
    float* __restrict z = v.z.data();
    float share = 1, scale = 1;
    for (std::uint32_t octave = 0; octave < static_cast<std::uint32_t>(p.octaves); ++octave) {
        const std::uint32_t key = noise_key(seed, NoisePurpose::Roughness, octave);
        for (std::size_t i = 0; i < count; ++i) {
            const float f = scale * frequency[i];
            z[i] += share * amplitude[i] * gradient_noise(key, f * x[i], f * y[i]);
        }
        share *= 0.5F;
        scale *= 2;
    }
    // The vertices of a node share its number, so that none changes where a thorn or a bundle splits one.
    const std::uint32_t* __restrict particle = v.particle.data();
    share = 1;
    for (std::uint32_t octave = 0; octave < static_cast<std::uint32_t>(p.white_octaves); ++octave) {
        for (std::size_t i = 0; i < count; ++i)
            z[i] += share * amplitude[i] *
                    (2 * random_unit(seed, NoisePurpose::WhiteNoise, particle[i], octave) - 1);
        share *= 0.5F;
    }
}

/// Faces of cells, of the walls between them and of the nodes where three or four runs meet.
class FaceMaker {
  public:
    FaceMaker(const BreakWorkspace::Buffers& b, const CellCorners& cells, BranchMesh& mesh)
        : m_b(b), m_cells(cells), m_mesh(mesh) {
        const PolarLattice& lattice = b.lattice;
        m_arc = 1 / static_cast<float>(lattice.sectors);
        m_step = 1 / static_cast<float>(lattice.rings);
    }

    void make() {
        const PolarLattice& lattice = m_b.lattice;
        const std::uint32_t* name = m_b.cells.name.data();
        for (int r = 0; r < lattice.rings; ++r) {
            make_room();
            for (int s = 0; s < lattice.sectors; ++s) {
                const int before = s > 0 ? s - 1 : lattice.sectors - 1;
                const std::size_t c = lattice.cell(r, s);
                add_top(r, s, c);
                if (r == 0) continue;
                const std::size_t beside = lattice.cell(r, before), inside = lattice.cell(r - 1, s);
                const bool ray_wall = name[beside] != name[c], ring_wall = name[inside] != name[c];
                if (ray_wall) add_ray_wall(r, m_cells.corners[beside], m_cells.corners[c]);
                if (ring_wall) add_ring_wall(r, s, m_cells.corners[inside], m_cells.corners[c]);
                if (ray_wall || ring_wall || name[lattice.cell(r - 1, before)] != name[inside])
                    add_node(r, before, c, beside, inside);
            }
        }
        resize(m_count);
    }

  private:
    /// Room for the four faces that each cell of a ring may bring; what is not used is cut off at the end.
    void resize(std::size_t count) {
        m_mesh.faces.resize(count);
        m_mesh.parts.resize(count);
        m_mesh.corner_uvs.resize(count);
    }
    void make_room() {
        const std::size_t needed = m_count + 4 * static_cast<std::size_t>(m_b.lattice.sectors);
        if (needed > m_mesh.faces.size()) resize(needed + needed / 4);
    }
    void push(const Face& face, Part part, const std::array<Vector2f, 4>& uv) {
        m_mesh.faces[m_count] = face;
        m_mesh.parts[m_count] = part;
        m_mesh.corner_uvs[m_count++] = uv;
    }
    Vector2f plan_uv(std::int32_t v) const {
        const auto i = static_cast<std::size_t>(v);
        return {0.5F * m_b.vertices.x[i] + 0.5F, 0.5F * m_b.vertices.y[i] + 0.5F};
    }
    /// Walls: along the wall and up, a unit for 2 pi radii as on the bark.
    Vector2f wall_uv(float along, std::int32_t v) const {
        return {along, m_b.vertices.z[static_cast<std::size_t>(v)] * (1 / kTwoPi<float>)};
    }

    void add_top(int r, int s, std::size_t c) {
        const auto& k = m_cells.of(r, s);
        const Part part = m_b.cells.tissue[c] == Tissue::Phloem ? Part::InnerBark : Part::EndGrain;
        if (r == 0)
            push({k[0], k[1], k[2], kNoVertex}, part,
                 {plan_uv(k[0]), plan_uv(k[1]), plan_uv(k[2]), Vector2f::Zero()});
        else
            push({k[0], k[1], k[2], k[3]}, part,
                 {plan_uv(k[0]), plan_uv(k[1]), plan_uv(k[2]), plan_uv(k[3])});
    }

    /// Between the cell at s - 1 and the one at s.
    void add_ray_wall(int r, const std::array<std::int32_t, 4>& a, const std::array<std::int32_t, 4>& b) {
        const float inner = static_cast<float>(r) * m_step * (1 / kTwoPi<float>);
        const float outer = static_cast<float>(r + 1) * m_step * (1 / kTwoPi<float>);
        push({a[3], a[2], b[1], b[0]}, Part::Fibres,
             {wall_uv(inner, a[3]), wall_uv(outer, a[2]), wall_uv(outer, b[1]), wall_uv(inner, b[0])});
    }

    /// Between the cell at r - 1 and the one at r.
    void add_ring_wall(int r, int s, const std::array<std::int32_t, 4>& inside,
                       const std::array<std::int32_t, 4>& c) {
        const float radius = static_cast<float>(r) * m_step;
        const float from = radius * static_cast<float>(s) * m_arc,
                    to = radius * static_cast<float>(s + 1) * m_arc;
        push({inside[1], c[0], c[3], inside[2]}, Part::Fibres,
             {wall_uv(from, inside[1]), wall_uv(from, c[0]), wall_uv(to, c[3]), wall_uv(to, inside[2])});
    }

    void add_node(int r, int before, std::size_t c, std::size_t beside, std::size_t inside) {
        const auto& corners = m_cells.corners;
        const std::array<std::int32_t, 4> around{corners[m_b.lattice.cell(r - 1, before)][2],
                                                 corners[beside][3], corners[c][0], corners[inside][1]};
        Face face{kNoVertex, kNoVertex, kNoVertex, kNoVertex};
        std::size_t count = 0;
        for (const std::int32_t v : around)
            if (count == 0 || face[count - 1] != v) face[count++] = v;
        while (count > 1 && face[count - 1] == face[0]) face[--count] = kNoVertex;
        if (count < 3) return;
        std::array<Vector2f, 4> uv;
        for (std::size_t k = 0; k < 4; ++k)
            uv[k] = face[k] == kNoVertex ? Vector2f::Zero() : plan_uv(face[k]);
        push(face, Part::Fibres, uv);
    }

    const BreakWorkspace::Buffers& m_b;
    const CellCorners& m_cells;
    BranchMesh& m_mesh;
    float m_arc, m_step;
    std::size_t m_count = 0;
};

}  // namespace

void build_surface(const FractureParameters& parameters, BreakWorkspace::Buffers& b, BreakEnds& ends) {
    ends.cells.rings = b.lattice.rings;
    ends.cells.sectors = b.lattice.sectors;
    VertexMaker(b, ends).make();
    add_roughness(parameters, b);

    BranchMesh& mesh = ends.stub;
    mesh.clear();
    FaceMaker(b, ends.cells, mesh).make();
    ends.surface_vertices = static_cast<std::int32_t>(b.vertices.x.size());
    ends.surface_faces = mesh.faces.size();
}

}  // namespace windfall::fracture
