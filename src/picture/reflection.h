#pragma once
// How a surface reflects: directions and weights, in a frame whose z axis is the normal.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "picture/scene.h"

namespace windfall::picture {

inline constexpr float kPi = std::numbers::pi_v<float>;

/// An orthonormal frame about a unit vector (Duff et al., "Building an orthonormal basis, revisited", JCGT
/// 2017).
struct Basis {
    Vec3f x, y, z;

    explicit Basis(const Vec3f& normal) : z(normal) {
        const float sign = std::copysign(1.0F, normal.z());
        const float a = -1 / (sign + normal.z());
        const float b = normal.x() * normal.y() * a;
        x = Vec3f(1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
        y = Vec3f(b, sign + normal.y() * normal.y() * a, -normal.y());
    }
    Vec3f to_world(const Vec3f& v) const { return v.x() * x + v.y() * y + v.z() * z; }
    Vec3f to_local(const Vec3f& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
};

/// A direction with density cos / pi.
inline Vec3f cosine_direction(std::array<float, 2> u) {
    const float r = std::sqrt(u[0]), phi = 2 * kPi * u[1];
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0F, 1 - u[0]))};
}

/// A direction evenly spread in the cone about +z with the given cosine of its half angle.
inline Vec3f cone_direction(std::array<float, 2> u, float cos_half_angle) {
    const float z = 1 - u[0] * (1 - cos_half_angle), phi = 2 * kPi * u[1];
    const float r = std::sqrt(std::max(0.0F, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Fresnel reflectance of a dielectric with 0.04 at normal incidence (Schlick 1994).
inline float fresnel(float cosine) {
    const float m = std::clamp(1 - cosine, 0.0F, 1.0F);
    return 0.04F + 0.96F * (m * m) * (m * m) * m;
}

/// The clear coat: GGX with Smith shadowing; directions point away from the surface, in the local frame.
/// Visible normals: Heitz, "Sampling the GGX distribution of visible normals", JCGT 7(4) (2018).
class Coat {
  public:
    explicit Coat(float roughness) : m_alpha(std::max(roughness * roughness, 1e-3F)) {}

    /// Reflectance times cosine of `in`, and the density with which `sample` finds `in`.
    struct Value {
        float reflected = 0;
        float density = 0;
    };
    Value value(const Vec3f& out, const Vec3f& in) const {
        if (out.z() <= 0 || in.z() <= 0) return {};
        const Vec3f half = (out + in).normalized();
        const float a2 = m_alpha * m_alpha;
        const float d = half.z() * half.z() * (a2 - 1) + 1;
        const float distribution = a2 / (kPi * d * d);
        const float g_out = 1 / (1 + lambda(out)), g = 1 / (1 + lambda(out) + lambda(in));
        return {fresnel(out.dot(half)) * distribution * g / (4 * out.z()),
                g_out * distribution / (4 * out.z())};
    }
    Vec3f sample(const Vec3f& out, std::array<float, 2> u) const {
        const Vec3f stretched = Vec3f(m_alpha * out.x(), m_alpha * out.y(), out.z()).normalized();
        const float length_sq = stretched.x() * stretched.x() + stretched.y() * stretched.y();
        const Vec3f t1 = length_sq > 0 ? Vec3f(Vec3f(-stretched.y(), stretched.x(), 0) / std::sqrt(length_sq))
                                       : Vec3f::UnitX();
        const Vec3f t2 = stretched.cross(t1);
        const float r = std::sqrt(u[0]), phi = 2 * kPi * u[1], p1 = r * std::cos(phi);
        const float s = 0.5F * (1 + stretched.z());
        const float p2 = (1 - s) * std::sqrt(std::max(0.0F, 1 - p1 * p1)) + s * r * std::sin(phi);
        const Vec3f n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0F, 1 - p1 * p1 - p2 * p2)) * stretched;
        const Vec3f half = Vec3f(m_alpha * n.x(), m_alpha * n.y(), std::max(1e-6F, n.z())).normalized();
        return 2 * out.dot(half) * half - out;
    }

  private:
    float lambda(const Vec3f& v) const {
        const float tan_sq = std::max(0.0F, 1 - v.z() * v.z()) / (v.z() * v.z());
        return 0.5F * (std::sqrt(1 + m_alpha * m_alpha * tan_sq) - 1);
    }
    float m_alpha;
};

/// Light that leaves the surface at a distance from where it went in: normalised diffusion, a sum of two
/// exponentials (Christensen and Burley, "Approximate reflectance profiles", 2015). Densities per area of the
/// tangent plane.
struct Diffusion {
    static float density(float radius, float mean_path) {
        const float r = std::max(radius, 1e-4F * mean_path);
        return (std::exp(-r / mean_path) + std::exp(-r / (3 * mean_path))) / (8 * kPi * mean_path * r);
    }
    /// A radius with that density; `u` picks one of the exponentials (1/4 and 3/4) and a place in it.
    static float sample_radius(float u, float mean_path) {
        const bool narrow = u < 0.25F;
        const float v = narrow ? 4 * u : (u - 0.25F) / 0.75F;
        return -(narrow ? 1.0F : 3.0F) * mean_path * std::log(std::max(1e-6F, 1 - v));
    }
};

}  // namespace windfall::picture
