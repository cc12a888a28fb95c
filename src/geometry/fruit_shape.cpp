#include "geometry/fruit_shape.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace windfall::geometry {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSpacing = kPi / 6;

double degrees(double radians) { return radians * 180 / kPi; }

}  // namespace

TenNumberFruit::TenNumberFruit(const std::array<double, 8>& radii, double stone_r1, double stone_r2)
    : m_radii(radii), m_flattening(radii[7] / radii[3]) {
    for (int i = 0; i < kPoints; ++i) {
        const double phi = -kPi / 2 + i * kSpacing;
        m_points[i] = radii[i] * Vec2(std::cos(phi), std::sin(phi));
    }
    m_points[0].x() = 0;
    m_points[kPoints - 1].x() = 0;
    // Slopes of the interpolating cubic spline: continuity of the second derivative gives a tridiagonal
    // system, m_{i-1} + 4 m_i + m_{i+1} = 3 (p_{i+1} - p_{i-1}) / h, closed by the clamped end slopes.
    Eigen::Matrix<double, kPoints, kPoints> system = Eigen::Matrix<double, kPoints, kPoints>::Zero();
    Eigen::Matrix<double, kPoints, 2> right = Eigen::Matrix<double, kPoints, 2>::Zero();
    system(0, 0) = system(kPoints - 1, kPoints - 1) = 1;
    right(0, 0) = radii[0];
    right(kPoints - 1, 0) = -radii[6];
    for (int i = 1; i + 1 < kPoints; ++i) {
        system(i, i - 1) = system(i, i + 1) = 1;
        system(i, i) = 4;
        right.row(i) = 3 * (m_points[i + 1] - m_points[i - 1]).transpose() / kSpacing;
    }
    const Eigen::Matrix<double, kPoints, 2> slopes = system.partialPivLu().solve(right);
    for (int i = 0; i < kPoints; ++i) m_slopes[i] = slopes.row(i).transpose();
    m_stone_axes = Vec3(stone_r2, stone_r1, m_flattening * stone_r2);
    check_shape();
}

Vec2 TenNumberFruit::generatrix(double phi) const {
    const double s = std::clamp((phi + kPi / 2) / kSpacing, 0.0, kPoints - 1.0);
    const int i = std::min(static_cast<int>(s), kPoints - 2);
    const double t = s - i;
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * m_points[i] + (3 * t2 - 2 * t3) * m_points[i + 1] +
           kSpacing * ((t3 - 2 * t2 + t) * m_slopes[i] + (t3 - t2) * m_slopes[i + 1]);
}

Vec2 TenNumberFruit::generatrix_slope(double phi) const {
    const double s = std::clamp((phi + kPi / 2) / kSpacing, 0.0, kPoints - 1.0);
    const int i = std::min(static_cast<int>(s), kPoints - 2);
    const double t = s - i;
    return 6 * (t * t - t) / kSpacing * (m_points[i] - m_points[i + 1]) +
           (3 * t * t - 4 * t + 1) * m_slopes[i] + (3 * t * t - 2 * t) * m_slopes[i + 1];
}

void TenNumberFruit::check_shape() const {
    constexpr int kSamples = 720;
    for (int k = 0; k <= kSamples; ++k) {
        const double phi = -kPi / 2 + kPi * k / kSamples;
        const Vec2 p = generatrix(phi);
        const Vec2 t = generatrix_slope(phi);
        if (k > 0 && k < kSamples && p.x() <= 0)
            throw InputError(
                fmt::format("the fruit's outline crosses its axis at {:.0f} degrees of latitude: bring "
                            "neighbouring radii fruit.r2 .. fruit.r7 closer to each other",
                            degrees(phi)));
        if (p.x() * t.y() - p.y() * t.x() <= 0)
            throw InputError(
                fmt::format("the fruit's outline folds back at {:.0f} degrees of latitude: bring "
                            "neighbouring radii fruit.r2 .. fruit.r7 closer to each other",
                            degrees(phi)));
        const double latitude = std::atan2(p.y(), p.x());
        const Vec3 direction(std::cos(latitude), std::sin(latitude), 0);
        if (stone_radius(direction) >= p.norm())
            throw InputError(
                fmt::format("the stone pierces the flesh at {:.0f} degrees of latitude (stone {:.3g}, flesh "
                            "{:.3g}): make "
                            "fruit.stone_r1 or fruit.stone_r2 smaller",
                            degrees(latitude), stone_radius(direction), p.norm()));
    }
}

double TenNumberFruit::polar_radius(double latitude) const {
    // The spline's parameter is close to the latitude: bisection brackets it, for any shape that passed
    // check_shape.
    double low = -kPi / 2;
    double high = kPi / 2;
    for (int k = 0; k < 60 && high - low > 1e-15; ++k) {
        const double middle = 0.5 * (low + high);
        const Vec2 p = generatrix(middle);
        (std::atan2(p.y(), std::max(p.x(), 0.0)) < latitude ? low : high) = middle;
    }
    return generatrix(0.5 * (low + high)).norm();
}

double TenNumberFruit::flesh_radius(const Vec3& direction) const {
    // In z scaled by r_4 / r_8 the fruit is a surface of revolution; lengths along a ray scale with the
    // direction.
    const Vec3 scaled(direction.x(), direction.y(), direction.z() / m_flattening);
    const double latitude = std::atan2(scaled.y(), std::hypot(scaled.x(), scaled.z()));
    return polar_radius(latitude) / scaled.norm();
}

double TenNumberFruit::stone_radius(const Vec3& direction) const {
    return 1 / direction.cwiseQuotient(m_stone_axes).norm();
}

Vec3 TenNumberFruit::half_extents() const {
    double widest = 0;
    double low = 0;
    double high = 0;
    constexpr int kSamples = 180;
    for (int k = 0; k <= kSamples; ++k) {
        const Vec2 p = generatrix(-kPi / 2 + kPi * k / kSamples);
        widest = std::max(widest, p.x());
        low = std::min(low, p.y());
        high = std::max(high, p.y());
    }
    return {widest, 0.5 * (high - low), widest * m_flattening};
}

}  // namespace windfall::geometry
