#include "picture/scene.h"

#include <algorithm>
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

namespace {

/// The axes of a picture taken from a side.
struct Side {
    Vec3f back, right, up;
    Side(float azimuth, float elevation)
        : back(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
               std::cos(elevation) * std::cos(azimuth)),
          right(std::cos(azimuth), 0, -std::sin(azimuth)),
          up(back.cross(right)) {}
};

/// From how far all points are seen within `reach` (a slope) of the middle of the picture.
float distance_for(const Region& region, const Vec3f& target, const Side& side, float reach) {
    float distance = 0;
    for (const Vec3f& p : region.points) {
        const Vec3f d = p - target;
        distance =
            std::max(distance, d.dot(side.back) +
                                   std::max(std::abs(d.dot(side.right)), std::abs(d.dot(side.up))) / reach);
    }
    return distance;
}

/// What is seen along an axis of the picture, as slopes.
struct Extent {
    float low = 1e30F, high = -1e30F;
    void add(float slope) {
        low = std::min(low, slope);
        high = std::max(high, slope);
    }
    float middle() const { return (low + high) / 2; }
};

}  // namespace

Camera frame_region(const Region& region, double azimuth_deg, double elevation_deg, Framing framing,
                    double margin) {
    Camera camera;
    camera.azimuth_deg = azimuth_deg;
    camera.elevation_deg = elevation_deg;
    const auto radians = [](double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180); };
    const float elevation = radians(elevation_deg);
    const auto reach = static_cast<float>(std::tan(radians(camera.vertical_field_of_view_deg) / 2) / margin);
    std::vector<Side> sides{Side(radians(azimuth_deg), elevation)};
    if (framing == Framing::AllSides)
        for (int i = 1; i < 24; ++i)
            sides.emplace_back(
                radians(azimuth_deg) + 2 * std::numbers::pi_v<float> * static_cast<float>(i) / 24, elevation);
    Vec3f target = region.centre;
    float distance = 0;
    constexpr int kRounds = 4;  // perspective makes the middle depend on the distance
    for (int round = 0;; ++round) {
        distance = 0;
        for (const Side& side : sides)
            distance = std::max(distance, distance_for(region, target, side, reach));
        if (round == kRounds) break;
        Extent across, above;
        for (const Side& side : sides)
            for (const Vec3f& p : region.points) {
                const Vec3f d = p - target;
                const float depth = distance - d.dot(side.back);
                across.add(d.dot(side.right) / depth);
                above.add(d.dot(side.up) / depth);
            }
        // as much room above as below, and from one side as much on the left as on the right
        target.y() += above.middle() * distance / std::cos(elevation);
        if (framing == Framing::OneSide) target += across.middle() * distance * sides[0].right;
    }
    camera.target = target;
    camera.distance = distance;
    return camera;
}

}  // namespace windfall::picture
