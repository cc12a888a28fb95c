#pragma once
// Light along single paths.
#include <vector>

#include "picture/reflection.h"
#include "picture/sampler.h"
#include "picture/scene.h"
#include "picture/surfaces.h"

namespace windfall::picture {

/// What one path from the camera brought, with the guides of the denoiser.
struct PathSample {
    Vec3f radiance = Vec3f::Zero();
    Vec3f albedo = Vec3f::Ones();  ///< colour of what the camera sees
    Vec3f normal = Vec3f::Zero();  ///< zero for the backdrop
};

/// Estimates the light that reaches a camera: next-event estimation for the distant lights, sky by the paths
/// that leave the scene, floor as a catcher of shadows. Read-only; may be used from several threads.
class Integrator {
  public:
    /// The scene and the surfaces made of it must outlive it. `bounces` >= 1.
    Integrator(const Scene& scene, const Surfaces& surfaces, int bounces);

    /// `height_in_picture` (0 bottom, 1 top) picks the colour of the backdrop.
    PathSample trace(const Ray& camera_ray, float height_in_picture, Sampler& sampler) const;

  private:
    struct Light {
        DistantLight light;
        Basis basis;
        float cos_half_angle;
        float density;   // of directions in the disc, 1/sr
        Vec3f radiance;  // of the disc
        float chance;    // of being chosen
    };
    struct LightSample {
        Vec3f direction;
        Vec3f radiance;  // over the density of the direction and the chance of the light
        float density = 0;
    };

    LightSample sample_light(Sampler& sampler) const;
    Vec3f discs_along(const Vec3f& direction, float bsdf_density) const;
    Vec3f lit_directly(const SurfacePoint& point, Sampler& sampler) const;
    Vec3f floor_light(const Vec3f& place, Sampler& sampler) const;
    Vec3f incoming(const Vec3f& origin, const Vec3f& direction, int bounce, Sampler& sampler) const;
    Vec3f diffuse(const SurfacePoint& point, int bounce, Sampler& sampler) const;
    Vec3f skin(const SurfacePoint& point, const Vec3f& out, Sampler& sampler) const;
    Vec3f coat(const SurfacePoint& point, const Vec3f& out, Sampler& sampler) const;
    SurfacePoint scattered(const SurfacePoint& point, Vec3f& weight, Sampler& sampler) const;
    float floor_distance(const Ray& ray) const;

    const Scene& m_scene;
    const Surfaces& m_surfaces;
    int m_bounces;
    std::vector<Light> m_lights;
    Vec3f m_open_floor_irradiance;  // on the floor where nothing casts a shadow
};

}  // namespace windfall::picture
