#include "fracture/crack_shape.h"

#include <algorithm>
#include <cmath>

namespace windfall::fracture {
namespace {

constexpr double kDeepest = 0.9;         // of the log's length
constexpr double kLeastJacobian = 0.05;  // of a cell's corner, over an undisturbed cell's area
constexpr double kLeastOfWander = 0.2;   // the same without cracks
constexpr double kAmpleJacobian = 0.35;  // cells that keep so much at the cut face do not fold below it
constexpr int kMostAttempts = 40;

double plan_cross(const Eigen::Vector2d& from, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a.x() - from.x()) * (b.y() - from.y()) - (a.y() - from.y()) * (b.x() - from.x());
}

}  // namespace

CrackShape::CrackShape(const FractureParameters& parameters)
    : m_section(parameters, crack_grid(parameters),
                draw_cracks(parameters, crack_room(crack_grid(parameters))),
                kDeepest * parameters.branch.length),
      m_wander(parameters, 1.0 / m_section.grid().rings, m_section.grid().sector_angle()),
      m_length(parameters.branch.length) {
    straighten();
}

Eigen::Vector2d CrackShape::cracked(int ring, int sector, double z, CrackSide side) const {
    const CrackGrid& grid = m_section.grid();
    const CrackShift shift = m_section.shift(ring, sector, z, side);
    const double radius = ring / static_cast<double>(grid.rings) + shift.radius;
    const double angle = sector * grid.sector_angle() + shift.angle;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Eigen::Vector2d CrackShape::at(int ring, int sector, double z, CrackSide side) const {
    return m_wander.moved(cracked(ring, sector, z, side), z);
}

CrackShape::Layer CrackShape::layer(double z) const {
    const CrackGrid& grid = m_section.grid();
    Layer result;
    result.left.resize(grid.node(grid.rings + 1, 0));
    for (int r = 0; r <= grid.rings; ++r)
        for (int s = 0; s < grid.sectors; ++s)
            result.left[grid.node(r, s)] = cracked(r, s, z, CrackSide::Left);
    m_wander.move(result.left, z);
    result.right = result.left;
    for (int r = 0; r <= grid.rings; ++r)
        for (int s = 0; s < grid.sectors; ++s)
            if (m_section.owner(r, s) >= 0) result.right[grid.node(r, s)] = at(r, s, z, CrackSide::Right);
    return result;
}

std::array<Eigen::Vector2d, 4> CrackShape::cell(int ring, int sector, double z) const {
    const int next = m_section.grid().wrapped_sector(sector + 1);
    const auto corner = [&](int r, int s) {
        return at(r, s, z, m_section.side_of_corner(r, s, ring, sector));
    };
    return {corner(ring, sector), corner(ring + 1, sector), corner(ring + 1, next), corner(ring, next)};
}

double CrackShape::least_jacobian(int ring, const std::array<Eigen::Vector2d, 4>& corners) const {
    const CrackGrid& grid = m_section.grid();
    const double area = grid.sector_angle() * (ring + 0.5) / grid.rings / grid.rings;
    if (ring == 0) return plan_cross(corners[0], corners[1], corners[2]) / area;
    return std::min({plan_cross(corners[0], corners[1], corners[3]),
                     plan_cross(corners[1], corners[2], corners[0]),
                     plan_cross(corners[2], corners[3], corners[1]),
                     plan_cross(corners[3], corners[0], corners[2])}) /
           area;
}

CrackShape::Cells CrackShape::pressed_cells(const Layer& layer, double limit) const {
    const CrackGrid& grid = m_section.grid();
    Cells result;
    for (int r = 0; r < grid.rings; ++r)
        for (int s = 0; s < grid.sectors; ++s) {
            const auto corner = [&](int ring, int sector) {
                const bool right = m_section.side_of_corner(ring, sector, r, s) == CrackSide::Right;
                return (right ? layer.right : layer.left)[grid.node(ring, sector)];
            };
            const int next = grid.wrapped_sector(s + 1);
            const std::array<Eigen::Vector2d, 4> p{corner(r, s), corner(r + 1, s), corner(r + 1, next),
                                                   corner(r, next)};
            if (!(least_jacobian(r, p) >= limit)) result.push_back({r, s});
        }
    return result;
}

CrackShape::Cells CrackShape::folded_cells(const Cells& cells) const {
    double deepest = 0;
    for (const LatticeCrack& c : m_section.cracks())
        deepest = std::max(deepest, *std::max_element(c.depth.begin(), c.depth.end()));
    Cells result;
    for (const CrackedSection::Cell& c : cells) {
        bool folds = !(least_jacobian(c.ring, cell(c.ring, c.sector, 0)) >= kLeastJacobian);
        for (double share = 0.02; !folds && share < 1; share *= 1.35)
            folds = !(least_jacobian(c.ring, cell(c.ring, c.sector, -share * deepest)) >= kLeastJacobian);
        if (folds) result.push_back(c);
    }
    return result;
}

void CrackShape::straighten() {
    for (int attempt = 1; attempt <= kMostAttempts; ++attempt) {
        m_cut_face = layer(0);
        m_lower_end = layer(-m_length);
        const Cells folds = folded_cells(pressed_cells(m_cut_face, kAmpleJacobian));
        const bool rays_fold = !pressed_cells(m_lower_end, kLeastOfWander).empty();
        if (folds.empty() && !rays_fold) return;
        if (rays_fold || !m_section.narrow_around(folds) || attempt % 4 == 0) m_wander.calm();
    }
    give_up();
}

void CrackShape::give_up() {
    while (true) {
        m_cut_face = layer(0);
        m_lower_end = layer(-m_length);
        const Cells folds = folded_cells(pressed_cells(m_cut_face, kAmpleJacobian));
        const bool rays_fold = !pressed_cells(m_lower_end, kLeastOfWander).empty();
        if (folds.empty() && !rays_fold) return;
        if (!m_section.close_around(folds) && !m_wander.stop()) return;
    }
}

}  // namespace windfall::fracture
