#include "picture/scene.h"

#include <cmath>
#include <numbers>

namespace windfall::picture {

Vec3f Sky::radiance(const Vec3f& direction) const {
    const float y = direction.y();
    const float t = std::sqrt(std::abs(y));  // most of the change is near the horizon, as in a real room
    return (1 - t) * horizon + t * (y > 0 ? zenith : nadir);
}

Camera frame_sphere(const Vec3f& centre, double radius, double azimuth_deg, double elevation_deg,
                    double margin) {
    Camera camera;
    camera.target = centre;
    camera.azimuth_deg = azimuth_deg;
    camera.elevation_deg = elevation_deg;
    const double half_angle = camera.vertical_field_of_view_deg * std::numbers::pi / 360;
    camera.distance = margin * radius / std::sin(half_angle);
    return camera;
}

}  // namespace windfall::picture
