// Where thorns stand: in the largest block of lattice cells around the middle of their hole.
#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "fracture/break_buffers.h"
#include "fracture/fringe.h"
#include "fracture/noise.h"
#include "fracture/thorn_mesh.h"

namespace windfall::fracture {
namespace {

// Share of the hole's width and depth that a thorn fills.
constexpr float kFootprint = 0.75F, kLength = 0.97F;
// How deep thorns are rooted below the surface, in radii.
constexpr float kRootDepth = 0.1F;
// Pieces of a strand on fine lattices. On coarse ones the strands would be most of the mesh: these get fewer.
constexpr int kFewestPieces = 4, kMostPieces = 6, kRingsPerPiece = 10;
// A block of more cells would be no fibre, and its sides no longer straight.
constexpr int kMostCells = 12;

struct Block {
    int r0, r1, s0, s1;  // rings r0 .. r1, sectors s0 .. s1 (s may pass the ends of the lattice)
};

class ThornPlacer {
  public:
    ThornPlacer(const FractureParameters& p, const BreakWorkspace::Buffers& b, BreakEnds& ends)
        : m_p(p),
          m_b(b),
          m_ends(ends),
          m_bend(static_cast<float>(kOutlineBend * p.branch.outline)),
          m_release(release(p, ends)) {}

    void place() {
        for (std::size_t i = 0; i < m_b.sites.size(); ++i) place(m_b.sites[i], static_cast<std::int32_t>(i));
    }

  private:
    std::size_t cell(int r, int s) const {
        const int sectors = m_b.lattice.sectors;
        return m_b.lattice.cell(r, ((s % sectors) + sectors) % sectors);
    }
    bool is_of(int r, int s, std::int32_t site) const {
        return r >= 1 && r < m_b.lattice.rings && m_b.cells.fibre[cell(r, s)] == site;
    }

    /// Height of an arc of so many sectors over its chord, in rings, once the branch has its outline.
    float sagitta(int ring, int sectors) const {
        return static_cast<float>(ring) * (1 + m_bend) * (1 - std::cos(0.5F * angle(sectors)));
    }
    float angle(int sectors) const {
        return static_cast<float>(sectors) * kTwoPi<float> / static_cast<float>(m_b.lattice.sectors);
    }

    Block grown(const ThornSite& site, std::int32_t index) const {
        Block block{site.ring, site.ring, site.sector, site.sector};
        const auto row = [&](int r) {
            for (int s = block.s0; s <= block.s1; ++s)
                if (!is_of(r, s, index)) return false;
            return true;
        };
        const auto column = [&](int s) {
            for (int r = block.r0; r <= block.r1; ++r)
                if (!is_of(r, s, index)) return false;
            return true;
        };
        // A block that is bent like its arcs would have its middle outside of itself.
        const auto is_straight = [&](int sectors) {
            return sagitta(block.r1, sectors) < 0.25F * static_cast<float>(block.r1 - block.r0 + 1);
        };
        const int most = kMostCells;
        for (bool grew = true; grew;) {
            grew = false;
            if (block.r1 - block.r0 < kMostCells && row(block.r1 + 1)) ++block.r1, grew = true;
            if (block.s1 - block.s0 + 1 < most && is_straight(block.s1 - block.s0 + 2) &&
                column(block.s1 + 1))
                ++block.s1, grew = true;
            if (block.r1 - block.r0 < kMostCells && row(block.r0 - 1)) --block.r0, grew = true;
            if (block.s1 - block.s0 + 1 < most && is_straight(block.s1 - block.s0 + 2) &&
                column(block.s0 - 1))
                --block.s0, grew = true;
        }
        return block;
    }

    /// The hole's corners as vertices; a strand's or a single cell's are just those of its cell.
    std::array<Vector2f, 4> corners(const Block& block) const {
        const auto at = [&](int r, int s, std::size_t corner) {
            const auto v = static_cast<std::size_t>(m_ends.cells.corners[cell(r, s)][corner]);
            return Vector2f(m_b.vertices.x[v], m_b.vertices.y[v]);
        };
        return {at(block.r0, block.s0, 0), at(block.r1, block.s0, 1), at(block.r1, block.s1, 2),
                at(block.r0, block.s1, 3)};
    }

    /// The corners drawn together so far that the sides, jittered as they are, stay outside.
    std::array<Vector2f, 4> footprint(const Block& block) const {
        std::array<Vector2f, 4> quad = corners(block);
        const Vector2f centre = 0.25F * (quad[0] + quad[1] + quad[2] + quad[3]);
        const float across = static_cast<float>(std::min(block.r1 - block.r0, block.s1 - block.s0) + 1);
        const bool single = block.r0 == block.r1 && block.s0 == block.s1;
        // The nodes along a side stray from its chord by up to half a cell (jitter and shift of both), and
        // the inner arc by its sagitta.
        const float stray = single ? 0.0F : (0.5F + sagitta(block.r0, block.s1 - block.s0 + 1)) / across;
        const float scale = std::max(0.1F, std::min(kFootprint, 1 - 2 * stray));
        for (Vector2f& p : quad) p = centre + scale * (p - centre);
        return quad;
    }

    void place(const ThornSite& site, std::int32_t index) {
        const Block block =
            site.strand ? Block{site.ring, site.ring, site.sector, site.sector} : grown(site, index);
        const bool stub = site.length > 0;
        BranchMesh& mesh = stub ? m_ends.stub : m_ends.piece;
        // The thorn begins where its own end's surface is nearest to the tip's side, so that it never reaches
        // beyond the hole's bottom.
        float lowest = 1e30F, highest = -1e30F;
        for (int r = block.r0; r <= block.r1; ++r)
            for (int s = block.s0; s <= block.s1; ++s)
                for (const std::int32_t v : m_ends.cells.corners[cell(r, s)]) {
                    lowest = std::min(lowest, m_b.vertices.z[static_cast<std::size_t>(v)]);
                    highest = std::max(highest, m_b.vertices.z[static_cast<std::size_t>(v)]);
                }
        ThornShape shape;
        shape.footprint = footprint(block);
        shape.surface = stub ? lowest : highest;
        shape.root = shape.surface + (stub ? -kRootDepth : kRootDepth);
        shape.tip = shape.surface + kLength * site.length;
        shape.shape = site.shape;
        shape.bundle = m_b.cells.name[cell(site.ring, site.sector)];
        shape.tissue = m_b.cells.tissue[cell(site.ring, site.sector)];
        if (site.strand) {
            thin(shape);
            add_strand(shape, std::clamp(m_b.lattice.rings / kRingsPerPiece, kFewestPieces, kMostPieces),
                       bend(shape), mesh);
        } else {
            add_thorn(shape, mesh);
        }
        ++(stub ? m_ends.stub_thorns : m_ends.piece_thorns);
    }

    /// Freed strands curl each in its own direction and lean outwards.
    Vector2f bend(const ThornShape& shape) const {
        if (m_release <= 0) return Vector2f::Zero();
        const float angle = kTwoPi<float> * unit_float(mixed_bits(shape.shape + 3));
        const float curl =
            static_cast<float>(m_p.fringe.strand_curl) * unit_float(mixed_bits(shape.shape + 5));
        const Vector2f lean = 0.15F * shape.footprint[0];
        return m_release * std::abs(shape.tip - shape.root) *
               (curl * Vector2f(std::cos(angle), std::sin(angle)) + lean);
    }

    /// A strand is as thick as asked where the cell has the room.
    void thin(ThornShape& shape) const {
        const Vector2f centre =
            0.25F * (shape.footprint[0] + shape.footprint[1] + shape.footprint[2] + shape.footprint[3]);
        const float thickness =
            static_cast<float>(m_p.fringe.strand_thickness) * (0.4F + unit_float(mixed_bits(shape.shape)));
        const Vector2f out =
            0.5F * (shape.footprint[1] + shape.footprint[2] - shape.footprint[0] - shape.footprint[3]);
        const Vector2f around =
            0.5F * (shape.footprint[2] + shape.footprint[3] - shape.footprint[0] - shape.footprint[1]);
        const float by_out = std::min(1.0F, thickness / std::max(1e-6F, out.norm()));
        const float by_around = std::min(1.0F, thickness / std::max(1e-6F, around.norm()));
        static constexpr std::array<float, 4> kOut{-0.5F, 0.5F, 0.5F, -0.5F},
            kAround{-0.5F, -0.5F, 0.5F, 0.5F};
        // 0.8: the parallelogram of the means lies within the quadrilateral
        for (std::size_t k = 0; k < 4; ++k)
            shape.footprint[k] = centre + 0.8F * (kOut[k] * by_out * out + kAround[k] * by_around * around);
    }

    const FractureParameters& m_p;
    const BreakWorkspace::Buffers& m_b;
    BreakEnds& m_ends;
    float m_bend, m_release;
};

}  // namespace

void add_thorns(const FractureParameters& parameters, const BreakWorkspace::Buffers& buffers,
                BreakEnds& ends) {
    ends.stub_thorns = ends.piece_thorns = 0;
    ThornPlacer(parameters, buffers, ends).place();
}

}  // namespace windfall::fracture
