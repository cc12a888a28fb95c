#include "picture/integrator.h"

#include <cmath>

#include "picture/grain.h"
#include "picture/texture_lookup.h"

namespace windfall::picture {
namespace {

/// Light that comes in by more than one reflection is cut here: rare bright paths would leave single white
/// dots.
constexpr float kBrightestIndirect = 8;

constexpr float kNoFloor = 1e30F;

Vec3f limited(const Vec3f& radiance) {
    const float brightest = radiance.maxCoeff();
    return brightest > kBrightestIndirect ? Vec3f(radiance * (kBrightestIndirect / brightest)) : radiance;
}

/// Irradiance of the upper half of the sky on a horizontal plane: 2 pi * integral of radiance * y dy over
/// 0..1.
Vec3f sky_irradiance(const Sky& sky) {
    constexpr int kSteps = 256;
    Vec3f sum = Vec3f::Zero();
    for (int i = 0; i < kSteps; ++i) {
        const float y = (static_cast<float>(i) + 0.5F) / kSteps;
        sum += sky.radiance(Vec3f(std::sqrt(1 - y * y), y, 0)) * y;
    }
    return sum * (2 * kPi / kSteps);
}

}  // namespace

Integrator::Integrator(const Scene& scene, const Surfaces& surfaces, int bounces)
    : m_scene(scene), m_surfaces(surfaces), m_bounces(bounces) {
    float total = 0;
    for (const DistantLight& light : scene.lights) total += luminance(light.irradiance);
    m_open_floor_irradiance = sky_irradiance(scene.sky);
    for (const DistantLight& light : scene.lights) {
        const float half_angle = light.angular_radius_deg * kPi / 180;
        const float cosine = std::cos(half_angle);
        const float solid_angle = 2 * kPi * (1 - cosine);
        const float sine = std::sin(half_angle);
        m_lights.push_back({light, Basis(light.direction), cosine, 1 / solid_angle,
                            light.irradiance / (kPi * sine * sine), luminance(light.irradiance) / total});
        m_open_floor_irradiance += light.irradiance * std::max(0.0F, light.direction.y());
    }
}

Integrator::LightSample Integrator::sample_light(Sampler& sampler) const {
    float pick = sampler.next2()[0];
    const auto u = sampler.next2();
    std::size_t i = 0;
    while (i + 1 < m_lights.size() && pick >= m_lights[i].chance) pick -= m_lights[i++].chance;
    const Light& chosen = m_lights[i];
    return {chosen.basis.to_world(cone_direction(u, chosen.cos_half_angle)),
            chosen.radiance / (chosen.density * chosen.chance), chosen.density * chosen.chance};
}

Vec3f Integrator::discs_along(const Vec3f& direction, float bsdf_density) const {
    Vec3f sum = Vec3f::Zero();
    for (const Light& light : m_lights)
        if (direction.dot(light.light.direction) >= light.cos_half_angle)
            sum += light.radiance * (bsdf_density / (bsdf_density + light.density * light.chance));
    return sum;
}

float Integrator::floor_distance(const Ray& ray) const {
    if (!m_scene.has_floor || ray.direction.y() > -1e-6F) return kNoFloor;
    return std::max(0.0F, (m_scene.floor.height - ray.origin.y()) / ray.direction.y());
}

/// Radiance of the discs on a diffuse surface of albedo 1.
Vec3f Integrator::lit_directly(const SurfacePoint& point, Sampler& sampler) const {
    if (m_lights.empty()) return Vec3f::Zero();
    const LightSample light = sample_light(sampler);
    const float cosine = light.direction.dot(point.normal);
    if (cosine <= 0 || m_surfaces.blocked({point.start, light.direction})) return Vec3f::Zero();
    return light.radiance * (cosine / kPi);
}

/// What comes along a ray from a surface, without the discs of the lights, which next-event estimation has
/// taken.
Vec3f Integrator::incoming(const Vec3f& origin, const Vec3f& direction, int bounce, Sampler& sampler) const {
    const Ray ray{origin, direction};
    const float to_floor = floor_distance(ray);
    if (bounce >= m_bounces) {
        if (to_floor < kNoFloor || m_surfaces.blocked(ray)) return Vec3f::Zero();
        return m_scene.sky.radiance(direction);
    }
    const auto hit = m_surfaces.first_hit({origin, direction, 0, to_floor});
    if (hit) {
        if (direction.dot(hit->face_normal) >= 0) return Vec3f::Zero();
        return diffuse(*hit, bounce + 1, sampler);
    }
    if (to_floor == kNoFloor) return m_scene.sky.radiance(direction);
    SurfacePoint floor;
    floor.place = floor.start = origin + to_floor * direction;
    floor.normal = floor.face_normal = Vec3f::UnitY();
    floor.albedo = m_scene.floor.albedo;
    return diffuse(floor, bounce + 1, sampler);
}

Vec3f Integrator::diffuse(const SurfacePoint& point, int bounce, Sampler& sampler) const {
    Vec3f sum = lit_directly(point, sampler);
    const Vec3f direction = Basis(point.normal).to_world(cosine_direction(sampler.next2()));
    if (direction.dot(point.face_normal) > 0)
        sum += limited(incoming(point.start, direction, bounce, sampler));
    return point.albedo.cwiseProduct(sum);
}

/// Where light that comes out at `point` went in; `weight` is set per colour. One probe along the normal: the
/// part of the surface that a fold hides counts as if it were `point` itself.
SurfacePoint Integrator::scattered(const SurfacePoint& point, Vec3f& weight, Sampler& sampler) const {
    const Vec3f& paths = point.scatter;
    weight = Vec3f::Ones();
    const auto u = sampler.next2();
    const auto v = sampler.next2();
    const int channel = std::min(2, static_cast<int>(3 * u[0]));
    if (paths[channel] <= 0) return point;
    const float radius = Diffusion::sample_radius(u[1], paths[channel]);
    Vec3f densities;
    for (int c = 0; c < 3; ++c) densities[c] = paths[c] > 0 ? Diffusion::density(radius, paths[c]) : 0;
    weight = densities * (3 / densities.sum());

    const Basis basis(point.normal);
    const float angle = 2 * kPi * v[0];
    const float reach = 2 * radius + 0.5F * paths.maxCoeff();
    const Vec3f above =
        point.place + radius * (std::cos(angle) * basis.x + std::sin(angle) * basis.y) + reach * point.normal;
    const auto hit = m_surfaces.first_hit({above, -point.normal, 0, 2 * reach});
    return hit && hit->normal.dot(point.normal) > 0 ? *hit : point;
}

Vec3f Integrator::coat(const SurfacePoint& point, const Vec3f& out, Sampler& sampler) const {
    const Coat coat(point.roughness);
    const Basis basis(point.normal);
    const Vec3f local_out = basis.to_local(out);
    Vec3f sum = Vec3f::Zero();
    if (!m_lights.empty()) {
        const LightSample light = sample_light(sampler);
        const auto value = coat.value(local_out, basis.to_local(light.direction));
        if (value.reflected > 0 && !m_surfaces.blocked({point.start, light.direction}))
            sum += light.radiance * (value.reflected * light.density / (light.density + value.density));
    }
    const Vec3f local_in = coat.sample(local_out, sampler.next2());
    const auto value = coat.value(local_out, local_in);
    const Vec3f direction = basis.to_world(local_in);
    if (value.density > 0 && direction.dot(point.face_normal) > 0) {
        Vec3f light = limited(incoming(point.start, direction, 1, sampler));
        const Vec3f discs = discs_along(direction, value.density);
        if (discs.maxCoeff() > 0 && !m_surfaces.blocked({point.start, direction})) light += discs;
        sum += light * (value.reflected / value.density);
    }
    return sum;
}

/// The first surface on a path: a clear coat over a soft body. Later ones are taken as diffuse, which no one
/// can tell and which keeps rare bright paths away.
Vec3f Integrator::skin(const SurfacePoint& point, const Vec3f& out, Sampler& sampler) const {
    const float reflected = point.gloss * fresnel(std::max(0.0F, out.dot(point.normal)));
    const float body = (1 - reflected) * luminance(point.albedo);
    const float coat_chance = reflected > 0 ? std::clamp(reflected / (reflected + body), 0.15F, 0.85F) : 0.0F;
    if (sampler.next2()[0] < coat_chance) return coat(point, out, sampler) * (point.gloss / coat_chance);
    Vec3f weight = Vec3f::Constant((1 - reflected) / (1 - coat_chance));
    if (point.scatter.maxCoeff() <= 0) return weight.cwiseProduct(diffuse(point, 1, sampler));
    Vec3f by_colour;
    SurfacePoint entry = scattered(point, by_colour, sampler);
    entry.albedo = point.albedo;
    return weight.cwiseProduct(by_colour).cwiseProduct(diffuse(entry, 1, sampler));
}

/// Irradiance on the floor over what it would be without anything on it.
Vec3f Integrator::floor_light(const Vec3f& place, Sampler& sampler) const {
    Vec3f light = Vec3f::Zero();
    if (!m_lights.empty()) {
        const LightSample sample = sample_light(sampler);
        if (sample.direction.y() > 0 && !m_surfaces.blocked({place, sample.direction}))
            light += sample.radiance * sample.direction.y();
    }
    const Vec3f up = cosine_direction(sampler.next2());
    light += kPi * limited(incoming(place, Vec3f(up.x(), up.z(), up.y()), m_bounces - 1, sampler));
    return light.cwiseQuotient(m_open_floor_irradiance.cwiseMax(1e-6F));
}

PathSample Integrator::trace(const Ray& camera_ray, float height_in_picture, Sampler& sampler) const {
    PathSample result;
    const float to_floor = floor_distance(camera_ray);
    Ray ray = camera_ray;
    ray.to = to_floor;
    if (auto hit = m_surfaces.first_hit(ray)) {
        apply_texture(*hit);
        apply_grain(*hit);
        result.albedo = hit->albedo;
        result.normal = hit->normal;
        if (ray.direction.dot(hit->face_normal) < 0) result.radiance = skin(*hit, -ray.direction, sampler);
        return result;
    }
    const Vec3f backdrop =
        height_in_picture * m_scene.backdrop_top + (1 - height_in_picture) * m_scene.backdrop_bottom;
    result.radiance = result.albedo = backdrop;
    if (to_floor < kNoFloor) {
        result.normal = Vec3f::UnitY();
        result.radiance = backdrop.cwiseProduct(floor_light(ray.origin + to_floor * ray.direction, sampler));
    }
    return result;
}

}  // namespace windfall::picture
