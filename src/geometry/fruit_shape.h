#pragma once
// Shapes that are star-shaped about their centre, given by polar radii: the ten-number fruit of Liu et al.
// 2015 (section 4.1, eq. (8), with the spacing of the control points corrected to pi/6) and the exact sphere.
#include <array>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

/// Flesh and stone of a fruit as polar radii along unit directions; the fruit's axis is y.
class FruitShape {
  public:
    virtual ~FruitShape() = default;
    virtual double flesh_radius(const Vec3& direction) const = 0;
    virtual double stone_radius(const Vec3& direction) const = 0;
    /// Half extents along x, y, z: the proportions from which directions are spread evenly over the surface.
    virtual Vec3 half_extents() const = 0;
};

class SphereShape final : public FruitShape {
  public:
    SphereShape(double flesh_radius, double stone_radius) : m_flesh(flesh_radius), m_stone(stone_radius) {}
    double flesh_radius(const Vec3&) const override { return m_flesh; }
    double stone_radius(const Vec3&) const override { return m_stone; }
    Vec3 half_extents() const override { return Vec3::Constant(m_flesh); }

  private:
    double m_flesh, m_stone;
};

/// The paper's fruit. Generatrix: the parametric cubic spline through x_i = r_i cos(phi_i), y_i = r_i
/// sin(phi_i), phi_i = -pi/2 + (i-1) pi/6, i = 1..7, with clamped ends dx/dphi = r_1, -r_7 and dy/dphi = 0,
/// turned about y along an ellipse with half axes r_4 (x) and r_8 (z). Stone: the ellipsoid (r2s, r1s, r8 r2s
/// / r4).
class TenNumberFruit final : public FruitShape {
  public:
    /// `radii`: r_1 .. r_8. Throws InputError where the generatrix is not star-shaped or crosses the axis, or
    /// the stone pierces the flesh's surface; the text names the place.
    TenNumberFruit(const std::array<double, 8>& radii, double stone_r1, double stone_r2);

    double flesh_radius(const Vec3& direction) const override;
    double stone_radius(const Vec3& direction) const override;
    Vec3 half_extents() const override;

    /// Point (x, y) of the generatrix at parameter phi in [-pi/2, pi/2].
    Vec2 generatrix(double phi) const;

  private:
    static constexpr int kPoints = 7;
    /// Polar radius in the plane of the generatrix at the latitude `latitude`.
    double polar_radius(double latitude) const;
    Vec2 generatrix_slope(double phi) const;
    void check_shape() const;

    std::array<double, 8> m_radii;
    std::array<Vec2, kPoints> m_points, m_slopes;
    Vec3 m_stone_axes;
    double m_flattening;  ///< r_8 / r_4
};

}  // namespace windfall::geometry
