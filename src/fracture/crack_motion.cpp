#include "fracture/crack_motion.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

// Nodes of a broken surface lie up to 0.22 cells off their places; a crack opens only beyond that, so that
// the vertices where it closes do not move to either side.
constexpr double kClosed = 0.3;  // cells
// Between these radii the wandering fades, so that the rim stays. It is gentler than in a log for that.
constexpr float kFadesFrom = 0.5F, kFadesTo = 0.98F;
constexpr double kGentle = 0.7;

double half_turned(double angle) { return angle - kTwoPi<double> * std::round(angle / kTwoPi<double>); }

/// Half opening at a place between nodes.
double opening_at(const LatticeCrack& crack, double along) {
    const double length = crack.end - crack.begin;
    const double at = (along - crack.begin - kClosed) / (length - 2 * kClosed) * length;
    if (at <= 0 || at >= length) return 0;
    const auto below = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(below);
    return (1 - part) * crack.opening[below] + part * crack.opening[below + 1];
}

FractureParameters gentle(FractureParameters parameters) {
    parameters.cracks.irregularity *= kGentle;
    return parameters;
}

}  // namespace

CrackMotion::CrackMotion(const FractureParameters& parameters, const CrackedSection& section)
    : m_section(section),
      m_wander(gentle(parameters), 1.0 / section.grid().rings, section.grid().sector_angle()) {}

CrackShift CrackMotion::shift(double radius, double angle, const SurfaceCell& cell,
                              std::optional<std::size_t> left_out) const {
    const CrackGrid& grid = m_section.grid();
    CrackShift result;
    for (const std::uint32_t index : m_section.moving(cell.sector)) {
        if (left_out == index) continue;
        const LatticeCrack& c = m_section.cracks()[index];
        if (c.crack.radial()) {
            const bool left = 2 * grid.wrapped_sector(cell.sector - c.line) < grid.sectors;
            // Within a quarter of a turn on the wrong side (of a crooked ray) .. three quarters on the right
            // one.
            const double aside = c.line * grid.sector_angle() + (left ? 0.25 : -0.25) * kTwoPi<double>;
            const double off = half_turned(angle - aside) + (left ? 0.25 : -0.25) * kTwoPi<double>;
            const double share = c.share_at(left ? off : -off);
            if (share > 0) result.angle += (left ? share : -share) * opening_at(c, radius * grid.rings);
        } else {
            const double off = c.line / static_cast<double>(grid.rings) - radius;
            const bool left = cell.ring < c.line;
            const double share = c.share_at(left ? off : -off);
            const double middle = 0.5 * (c.begin + c.end) * grid.sector_angle();
            const double along = (middle + half_turned(angle - middle)) / grid.sector_angle();
            if (share > 0) result.radius -= (left ? share : -share) * opening_at(c, along);
        }
    }
    return result;
}

Eigen::Vector2d CrackMotion::moved_apart(const Eigen::Vector2d& point, const SurfaceCell& cell,
                                         std::optional<std::size_t> left_out) const {
    const double radius = point.norm();
    if (radius <= 0) return point;
    const double angle = std::atan2(point.y(), point.x());
    const CrackShift s = shift(radius, angle, cell, left_out);
    if (s.angle == 0 && s.radius == 0) return point;
    const double r = radius + s.radius, a = angle + s.angle;
    return {r * std::cos(a), r * std::sin(a)};
}

void CrackMotion::wander(std::vector<Eigen::Vector2d>& points) const {
    std::vector<Eigen::Vector2d> wandered = points;
    m_wander.move(wandered, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double fade = 1 - smooth_step(kFadesFrom, kFadesTo, static_cast<float>(points[i].norm()));
        points[i] += fade * (wandered[i] - points[i]);
    }
}

}  // namespace windfall::fracture
