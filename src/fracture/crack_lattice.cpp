#include "fracture/crack_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angles.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

constexpr double kTaper = 0.6;           // openings and depths end as tent^0.6: rounded, not as a rhombus
constexpr double kCheckTip = 0.1;        // radii from the check's tip to where it is fully open ...
constexpr double kCheckTipDepth = 0.35;  // ... and fully deep
constexpr double kMostCrooked = 0.1;     // rad of opening by which the check's strays are measured
constexpr double kRaggedness = 0.15;     // of the cracks' bottoms

/// How far from a crack wood gives way. Wide enough that a cell beside a crack loses less than half its
/// width.
double reach_of(const Crack& crack) {
    const double wide = 2.2 * crack.half_width;
    switch (crack.rank) {
        case CrackRank::Check:
            return std::min(0.55 + wide, 0.98 * std::numbers::pi);
        case CrackRank::Tangential:  // neither the pith nor the bark moves
            return std::min({0.04 + wide, crack.line, 1 - crack.line});
        default:
            return 0.10 + wide;
    }
}

/// 0 at both ends, 1 in the middle; `at` = 0 .. 1.
double tent(double at) { return std::pow(std::max(0.0, 1 - std::abs(2 * at - 1)), kTaper); }

double rising(double from_tip, double length) {
    return std::pow(std::clamp(from_tip / length, 0.0, 1.0), kTaper);
}

}  // namespace

double CrackGrid::sector_angle() const { return kTwoPi<double> / sectors; }

CrackGrid crack_grid(const FractureParameters& parameters) {
    CrackGrid grid;
    grid.rings = static_cast<int>(parameters.branch.rings);
    grid.sectors = static_cast<int>(parameters.branch.sectors);
    grid.wood_rings =
        std::clamp(static_cast<int>(grid.rings * (1 - parameters.tissue.phloem)), 1, grid.rings - 1);
    return grid;
}

CrackRoom crack_room(const CrackGrid& grid) {
    // Two and a half cells between cracks stay two when both have been moved to their nearest lines.
    CrackRoom room;
    room.along_ray = std::max(room.along_ray, 2.5 / grid.rings);
    room.least_angle = 2.5 * grid.sector_angle();
    return room;
}

CrackedSection::CrackedSection(const FractureParameters& parameters, const CrackGrid& grid,
                               const CrackSet& set, double deepest)
    : m_grid(grid), m_seed(noise_seed(parameters.seed)) {
    snap(set, deepest);
    claim_nodes();
    list_by_sector();
    limit_openings();
}

void CrackedSection::snap(const CrackSet& set, double deepest) {
    m_count = set.count;
    for (const Crack& crack : set.cracks) {
        LatticeCrack placed;
        if (lay_on_lattice(crack, deepest, placed)) {
            m_cracks.push_back(std::move(placed));
        } else {
            ++m_count.dropped;
            --m_count.opened;
            if (crack.narrowed) --m_count.narrowed;
        }
    }
}

bool CrackedSection::lay_on_lattice(const Crack& crack, double deepest, LatticeCrack& result) const {
    const auto nearest = [](double x) { return static_cast<int>(std::lround(x)); };
    const double cell = m_grid.sector_angle();
    result.crack = crack;
    // Never less than a cell: the edge of a crack always moves as one.
    result.reach = std::max(reach_of(crack), crack.radial() ? cell : 1.0 / m_grid.rings);
    if (crack.radial()) {
        result.line = m_grid.wrapped_sector(nearest(crack.line / cell));
        result.begin = std::max(1, nearest(crack.begin * m_grid.rings));
        result.end = crack.reaches_bark()
                         ? m_grid.rings + 1
                         : std::min(m_grid.wood_rings - 1, nearest(crack.end * m_grid.rings));
    } else {
        result.line = nearest(crack.line * m_grid.rings);
        result.begin = nearest(crack.begin / cell);
        result.end = nearest(crack.end / cell);
        if (result.line < 2 || result.line >= m_grid.wood_rings) return false;
    }
    if (result.end - result.begin < 2) return false;

    const std::uint32_t ragged =
        noise_key(m_seed, NoisePurpose::Crack, crack.index, 100, static_cast<std::uint32_t>(crack.rank));
    const double deep = std::min(crack.depth, deepest);
    for (int along = result.begin; along <= result.end; ++along) {
        const double at = (along - result.begin) / static_cast<double>(result.end - result.begin);
        const double radius = crack.radial() ? along / static_cast<double>(m_grid.rings) : crack.line;
        const double arc = crack.radial() ? radius : radius * cell * along;
        double noise = kRaggedness * gradient_noise(ragged, static_cast<float>(50 * arc), 0.5F);
        double open = tent(at), down = open;
        if (crack.reaches_bark()) {
            const double from_tip = (along - result.begin) / static_cast<double>(m_grid.rings);
            open = rising(from_tip, kCheckTip);
            down = rising(from_tip, kCheckTipDepth);
            noise *= std::max(0.0, 1 - radius);
        }
        result.opening.push_back(crack.half_width * open);
        result.depth.push_back(std::min(deep * down * (1 + noise), deepest));
    }
    return true;
}

void CrackedSection::claim_nodes() {
    m_owner.assign(m_grid.node(m_grid.rings + 1, 0), -1);
    for (std::size_t k = 0; k < m_cracks.size(); ++k) {
        const LatticeCrack& c = m_cracks[k];
        for (int along = c.begin + 1; along < c.end; ++along) {
            const std::size_t node = c.crack.radial() ? m_grid.node(along, c.line)
                                                      : m_grid.node(c.line, m_grid.wrapped_sector(along));
            m_owner[node] = static_cast<std::int32_t>(k);
        }
    }
}

void CrackedSection::list_by_sector() {
    std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(m_grid.sectors));
    for (std::size_t k = 0; k < m_cracks.size(); ++k) {
        const LatticeCrack& c = m_cracks[k];
        int first = c.begin, last = c.end;
        if (c.crack.radial()) {
            const int half = static_cast<int>(c.reach / m_grid.sector_angle()) + 2;
            first = c.line - half;
            last = c.line + half;
        }
        last = std::min(last, first + m_grid.sectors - 1);
        for (int s = first; s <= last; ++s)
            lists[static_cast<std::size_t>(m_grid.wrapped_sector(s))].push_back(
                static_cast<std::uint32_t>(k));
    }
    m_sector_first.assign(1, 0);
    for (const auto& list : lists) {
        m_in_sector.insert(m_in_sector.end(), list.begin(), list.end());
        m_sector_first.push_back(static_cast<std::uint32_t>(m_in_sector.size()));
    }
}

CrackSide CrackedSection::side_of_corner(int ring, int sector, int cell_ring, int cell_sector) const {
    const std::int32_t index = owner(ring, sector);
    if (index < 0) return CrackSide::Left;
    const LatticeCrack& crack = m_cracks[static_cast<std::size_t>(index)];
    const bool left = crack.crack.radial() ? cell_sector == crack.line : cell_ring < crack.line;
    return left ? CrackSide::Left : CrackSide::Right;
}

/// How far the check strays from its ray, over its half opening: its walls are rough, its edge in the bark is
/// not straight.
double CrackedSection::crookedness(double radius, double z) const {
    const auto noise = [&](std::uint32_t octave, double along_ray, double along_axis) {
        return gradient_noise(noise_key(m_seed, NoisePurpose::Crack, octave, 101),
                              static_cast<float>(along_ray * radius), static_cast<float>(along_axis * z));
    };
    return 0.22 * noise(0, 4, 1.5) + 0.1 * noise(1, 11, 3.3) + 0.06 * noise(2, 33, 5);
}

CrackShift CrackedSection::shift(int ring, int sector, double z, CrackSide side) const {
    CrackShift result;
    for (const std::uint32_t index : moving(sector)) {
        const LatticeCrack& c = m_cracks[index];
        const bool radial = c.crack.radial();
        int along = ring, off = 0;  // off: to the left of the crack
        if (radial) {
            off = m_grid.wrapped_sector(sector - c.line);
            if (2 * off > m_grid.sectors) off -= m_grid.sectors;
        } else {
            along = c.begin + m_grid.wrapped_sector(sector - c.begin);
            off = c.line - ring;
        }
        if (along <= c.begin || along >= c.end) continue;
        const double share =
            c.share_at(std::abs(off) * (radial ? m_grid.sector_angle() : 1.0 / m_grid.rings));
        const double upper = 1 + z / c.depth[c.entry(along)];  // 1 at the cut face, 0 at the bottom
        if (share <= 0) continue;
        const double opening = c.opening[c.entry(along)];
        if (c.crack.reaches_bark())
            result.angle += share * std::min(opening, kMostCrooked) *
                            crookedness(ring / static_cast<double>(m_grid.rings), z);
        if (upper <= 0) continue;
        const double sign = off != 0 ? (off > 0 ? 1 : -1) : static_cast<double>(side);
        (radial ? result.angle : result.radius) += (radial ? sign : -sign) * opening * share * upper;
    }
    return result;
}

}  // namespace windfall::fracture
