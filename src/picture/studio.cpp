#include "picture/studio.h"

#include <cmath>
#include <numbers>

namespace windfall::picture {
namespace {

/// Angles about the camera's own.
Vec3f light_from(const Camera& camera, double azimuth_deg, double elevation_deg) {
    const double a = (camera.azimuth_deg + azimuth_deg) * std::numbers::pi / 180;
    const double e = elevation_deg * std::numbers::pi / 180;
    return {static_cast<float>(std::cos(e) * std::sin(a)), static_cast<float>(std::sin(e)),
            static_cast<float>(std::cos(e) * std::cos(a))};
}

}  // namespace

void set_studio(Scene& scene, const Camera& camera) {
    scene.lights = {{light_from(camera, -48, 46), 14, Vec3f(2.9F, 2.75F, 2.5F)},
                    {light_from(camera, 140, 30), 11, Vec3f(0.75F, 0.8F, 0.9F)}};
    scene.sky = {Vec3f(0.55F, 0.57F, 0.61F), Vec3f(0.38F, 0.38F, 0.39F), Vec3f(0.25F, 0.24F, 0.23F)};
    scene.floor.albedo = Vec3f::Constant(0.55F);
    scene.backdrop_top = Vec3f(0.60F, 0.60F, 0.61F);
    scene.backdrop_bottom = Vec3f(0.80F, 0.79F, 0.78F);
    scene.camera = camera;
}

void set_wood_studio(Scene& scene, const Camera& camera) {
    set_studio(scene, camera);
    scene.lights = {{light_from(camera, -58, 40), 5, Vec3f(3.2F, 2.95F, 2.6F)},
                    {light_from(camera, 135, 25), 11, Vec3f(0.6F, 0.66F, 0.78F)}};
    scene.backdrop_top = Vec3f(0.30F, 0.32F, 0.34F);
    scene.backdrop_bottom = Vec3f(0.44F, 0.45F, 0.46F);
}

void set_diagram(Scene& scene, const Camera& camera) {
    set_studio(scene, camera);
    for (DistantLight& light : scene.lights) {
        light.irradiance = Vec3f::Constant(0.24F * light.irradiance.y());
        light.angular_radius_deg = 25;
    }
    scene.sky = {Vec3f::Constant(0.85F), Vec3f::Constant(0.78F), Vec3f::Constant(0.6F)};
    scene.floor.albedo = Vec3f::Constant(0.7F);
    scene.backdrop_top = scene.backdrop_bottom = Vec3f::Ones();
}

}  // namespace windfall::picture
