#pragma once
// What a fruit may not enter: the table, a bowl, another fruit, as planes that are refreshed every frame.
#include <Eigen/Core>
#include <functional>
#include <limits>

namespace windfall::decay {

/// Half-space that a point must stay in: normal . x >= offset_m, with a unit normal.
struct ContactPlane {
    Eigen::Vector3f normal{0, 0, 1};
    float offset_m = -std::numeric_limits<float>::infinity();  ///< the default forbids nothing

    /// Distance of a point above the plane (m); negative below, +infinity for the default plane.
    float gap_m(const Eigen::Vector3f& point) const { return normal.dot(point) - offset_m; }
};

/// The plane of the standing obstacle nearest to a point (m, z up).
using Ground = std::function<ContactPlane(const Eigen::Vector3f& point)>;

/// The table z = 0.
Ground table_ground();

/// The inside of a bowl that stands on the table: a sphere of `radius_m` touching z = 0 in the origin, up to
/// `height_m` (<= radius); elsewhere the table.
Ground bowl_ground(double radius_m, double height_m);

}  // namespace windfall::decay
