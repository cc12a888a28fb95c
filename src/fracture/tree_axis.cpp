#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fracture/tree_branch.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

/// Unit vectors along the curve, by central differences.
std::vector<Vec3> directions_along(const std::vector<Vec3>& centres) {
    std::vector<Vec3> along(centres.size());
    for (std::size_t i = 0; i < centres.size(); ++i)
        along[i] = (centres[std::min(i + 1, centres.size() - 1)] - centres[i > 0 ? i - 1 : 0]).normalized();
    return along;
}

/// The vector across at the next place of a curve that turns least about it: two reflections (Wang, Juettler,
/// Zheng, Liu, Computation of rotation minimizing frames, ACM TOG 2008, table I).
Vec3 carried(const AxisFrame& from, const Vec3& to_centre, const Vec3& to_along) {
    const Vec3 v1 = to_centre - from.centre;
    const double c1 = v1.squaredNorm();
    const Vec3 across = from.across - 2 / c1 * v1.dot(from.across) * v1;
    const Vec3 along = from.along - 2 / c1 * v1.dot(from.along) * v1;
    const Vec3 v2 = to_along - along;
    const double c2 = v2.squaredNorm();
    return c2 > 0 ? Vec3(across - 2 / c2 * v2.dot(across) * v2) : across;
}

}  // namespace

Vec3 AxisFrame::direction(double angle) const { return std::cos(angle) * across + std::sin(angle) * third(); }

BranchAxis::BranchAxis(std::vector<Vec3> centres, std::size_t zero, double step, const Vec3& across)
    : m_frames(centres.size()), m_zero(zero), m_step(step) {
    const std::vector<Vec3> along = directions_along(centres);
    for (std::size_t i = 0; i < centres.size(); ++i) m_frames[i] = {centres[i], along[i], Vec3::Zero()};
    AxisFrame& middle = m_frames[zero];
    middle.across = (across - across.dot(middle.along) * middle.along).normalized();
    for (std::size_t i = zero + 1; i < centres.size(); ++i)
        m_frames[i].across = carried(m_frames[i - 1], centres[i], along[i]);
    for (std::size_t i = zero; i-- > 0;) m_frames[i].across = carried(m_frames[i + 1], centres[i], along[i]);
}

AxisFrame BranchAxis::at(double height) const {
    const double place = (height - lowest()) / m_step;
    const auto last = static_cast<double>(m_frames.size() - 1);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last - 1));
    const double t = place - static_cast<double>(i);
    const AxisFrame &a = m_frames[i], &b = m_frames[i + 1];
    AxisFrame frame;
    if (t < 0 || t > 1) {
        frame = t < 0 ? a : b;
        frame.centre += m_step * (t < 0 ? t : t - 1) * frame.along;
        return frame;
    }
    // Beyond an end the curve is continued by reflecting its last step.
    const Vec3 before = i > 0 ? m_frames[i - 1].centre : Vec3(2 * a.centre - b.centre);
    const Vec3 behind = i + 2 < m_frames.size() ? m_frames[i + 2].centre : Vec3(2 * b.centre - a.centre);
    frame.centre = 0.5 * (2 * a.centre + t * (b.centre - before) +
                          t * t * (2 * before - 5 * a.centre + 4 * b.centre - behind) +
                          t * t * t * (3 * a.centre - before - 3 * b.centre + behind));
    frame.along = ((1 - t) * a.along + t * b.along).normalized();
    const Vec3 across = (1 - t) * a.across + t * b.across;
    frame.across = (across - across.dot(frame.along) * frame.along).normalized();
    return frame;
}

double BranchAxis::height_of(const Vec3& point) const {
    // The first plane that has the point behind it, among those near it.
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < m_frames.size(); ++i)
        if ((m_frames[i].centre - point).squaredNorm() < (m_frames[nearest].centre - point).squaredNorm())
            nearest = i;
    double height = lowest() + static_cast<double>(nearest) * m_step;
    for (int round = 0; round < 8; ++round) {
        const AxisFrame frame = at(height);
        height += (point - frame.centre).dot(frame.along);
    }
    return height;
}

double BranchAxis::sharpest_turn() const {
    double most = 0;
    for (std::size_t i = 1; i < m_frames.size(); ++i)
        most = std::max(most, std::atan2(m_frames[i].along.cross(m_frames[i - 1].along).norm(),
                                         m_frames[i].along.dot(m_frames[i - 1].along)));
    return most;
}

}  // namespace windfall::fracture
