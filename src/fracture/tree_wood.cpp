#include "fracture/tree_wood.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace windfall::fracture {

using geometry::Vec3;

Vec3 WoodMap::place(const Vector3f& point) const {
    const double x = point.x(), y = point.y(), r = std::hypot(x, y);
    const double height = unit * (static_cast<double>(point.z()) - middle);
    const AxisFrame frame = axis.at(height);
    if (r == 0) return frame.centre;
    const auto out = [&](const AxisFrame& f) { return Vec3((x / r) * f.across + (y / r) * f.third()); };
    const AxisFrame near = axis.at(std::clamp(height, low, high));
    const double rho = (rays.hit(near.centre, out(near)).position - near.centre).dot(out(near));
    return frame.centre + r * rho * out(frame);
}

std::vector<Vec3> WoodMap::places(const std::vector<Vector3f>& points) const {
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Vector3f& point : points) result.push_back(place(point));
    return result;
}

std::vector<std::array<Vector3f, 4>> corner_normals(const BranchMesh& mesh, const std::vector<Vec3>& places,
                                                    const Vec3& centre, double unit) {
    BranchMesh placed;
    placed.faces = mesh.faces;
    placed.parts = mesh.parts;
    for (const Vec3& place : places) placed.positions.emplace_back(((place - centre) / unit).cast<float>());
    compute_normals(placed);
    std::vector<std::array<Vector3f, 4>> normals(mesh.faces.size());
    for (std::size_t f = 0; f < normals.size(); ++f)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t v = mesh.faces[f][k];
            const bool smooth = v != geometry::kNoVertex && is_smooth(mesh.parts[f]);
            normals[f][k] = smooth ? placed.normals[static_cast<std::size_t>(v)] : placed.face_normals[f];
        }
    return normals;
}

}  // namespace windfall::fracture
