#include "decay/body_ground.h"

#include <cmath>

namespace windfall::decay {

Ground table_ground() {
    return [](const Eigen::Vector3f&) { return ContactPlane{{0, 0, 1}, 0}; };
}

Ground bowl_ground(double radius_m, double height_m) {
    const auto radius = static_cast<float>(radius_m);
    const auto rim_height = static_cast<float>(height_m);
    const float rim_radius = std::sqrt(radius * radius - (radius - rim_height) * (radius - rim_height));
    return [=](const Eigen::Vector3f& point) {
        const Eigen::Vector3f centre(0, 0, radius);
        if (point.head<2>().norm() < rim_radius && point.z() < rim_height) {
            // In the middle of the sphere every direction is as good.
            const Eigen::Vector3f out = point - centre;
            const float distance = out.norm();
            const Eigen::Vector3f normal =
                distance > 0 ? Eigen::Vector3f(-out / distance) : Eigen::Vector3f(0, 0, 1);
            return ContactPlane{normal, normal.dot(centre) - radius};
        }
        return ContactPlane{{0, 0, 1}, 0};
    };
}

}  // namespace windfall::decay
