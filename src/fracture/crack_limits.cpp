// Keeps the wood between cracks from folding over.
#include <algorithm>
#include <cmath>

#include "fracture/crack_lattice.h"

namespace windfall::fracture {
namespace {

constexpr double kMostPressed = 0.6;  // share of its width that a cell may lose

/// Calls body(edge, loss) for the edges between neighbouring nodes that a crack makes shorter: `edge` is the
/// node at which it begins (towards the next sector for a radial crack, the next ring for a tangential one).
template <class Body>
void for_each_pressed_edge(const CrackGrid& grid, const LatticeCrack& c, const Body& body) {
    const bool radial = c.crack.radial();
    const double step = radial ? grid.sector_angle() : 1.0 / grid.rings;
    const int farthest = radial ? (grid.sectors - 1) / 2 : std::min(c.line, grid.rings - c.line) - 1;
    const int half = std::min(static_cast<int>(c.reach / step), farthest);
    for (int along = c.begin + 1; along < c.end; ++along)
        for (int off = -half - 1; off <= half; ++off) {
            const double loss =
                std::abs(c.share_at(std::abs(off) * step) - c.share_at(std::abs(off + 1) * step));
            const std::size_t edge = radial ? grid.node(along, grid.wrapped_sector(c.line + off))
                                            : grid.node(c.line + off, grid.wrapped_sector(along));
            body(edge, loss * c.opening[c.entry(along)] / step);
        }
}

}  // namespace

void CrackedSection::scale(LatticeCrack& crack, double factor) {
    for (double& opening : crack.opening) opening *= factor;
    crack.crack.half_width *= factor;
    if (!crack.crack.narrowed) ++m_count.narrowed;
    crack.crack.narrowed = true;
}

// Each crack shrinks by the worst cell in its reach, so that no sum of losses stays above the limit.
void CrackedSection::limit_openings() {
    for (const bool radial : {true, false}) {
        std::vector<double> losses(m_owner.size(), 0.0);
        for (const LatticeCrack& c : m_cracks)
            if (c.crack.radial() == radial)
                for_each_pressed_edge(m_grid, c, [&](std::size_t e, double loss) { losses[e] += loss; });
        for (LatticeCrack& c : m_cracks) {
            if (c.crack.radial() != radial) continue;
            double worst = 0;
            for_each_pressed_edge(m_grid, c, [&](std::size_t e, double loss) {
                if (loss > 0) worst = std::max(worst, losses[e]);
            });
            if (worst > kMostPressed) scale(c, kMostPressed / worst);
        }
    }
}

bool CrackedSection::moves_cell(const LatticeCrack& crack, const Cell& cell) const {
    for (const int r : {cell.ring, cell.ring + 1})
        for (const int s : {cell.sector, m_grid.wrapped_sector(cell.sector + 1)}) {
            int along = r, off = m_grid.wrapped_sector(s - crack.line);
            off = std::min(off, m_grid.sectors - off);
            double distance = off * m_grid.sector_angle();
            if (!crack.crack.radial()) {
                along = crack.begin + m_grid.wrapped_sector(s - crack.begin);
                distance = std::abs(r - crack.line) / static_cast<double>(m_grid.rings);
            }
            if (along > crack.begin && along < crack.end && distance < crack.reach) return true;
        }
    return false;
}

bool CrackedSection::narrow_around(const std::vector<Cell>& cells) {
    bool any = false;
    for (LatticeCrack& crack : m_cracks) {
        const bool moves_one = std::any_of(cells.begin(), cells.end(),
                                           [&](const Cell& cell) { return moves_cell(crack, cell); });
        if (!moves_one) continue;
        scale(crack, 0.5);
        any = true;
    }
    return any;
}

bool CrackedSection::close_around(const std::vector<Cell>& cells) {
    bool any = false;
    for (LatticeCrack& crack : m_cracks) {
        const bool moves_one = crack.crack.half_width > 0 &&
                               std::any_of(cells.begin(), cells.end(),
                                           [&](const Cell& cell) { return moves_cell(crack, cell); });
        if (!moves_one) continue;
        for (double& opening : crack.opening) opening = 0;
        crack.crack.half_width = 0;
        ++m_count.dropped;
        --m_count.opened;
        if (crack.crack.narrowed) --m_count.narrowed;
        crack.crack.narrowed = false;
        any = true;
    }
    return any;
}

}  // namespace windfall::fracture
