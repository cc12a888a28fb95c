#include "geometry/surface_mesh.h"

#include <Eigen/Geometry>

namespace windfall::geometry {

namespace {

/// Twice the vector area of a face: exact for triangles, the diagonals' cross product for quadrilaterals.
Vec3 twice_vector_area(const std::vector<Vec3>& positions, const Face& face) {
    const Vec3& a = positions[face[0]];
    const Vec3& b = positions[face[1]];
    const Vec3& c = positions[face[2]];
    if (corner_count(face) == 3) return (b - a).cross(c - a);
    return (c - a).cross(positions[face[3]] - b);
}

}  // namespace

std::vector<Vec3> vertex_normals(const std::vector<Vec3>& positions, const std::vector<Face>& faces) {
    std::vector<Vec3> normals(positions.size(), Vec3::Zero());
    for (const Face& face : faces) {
        const Vec3 area = twice_vector_area(positions, face);
        for (int c = 0; c < corner_count(face); ++c) normals[face[c]] += area;
    }
    for (Vec3& normal : normals) normal.normalize();
    return normals;
}

double enclosed_volume(const std::vector<Vec3>& positions, const std::vector<Face>& faces) {
    double six_volumes = 0;
    for (const Face& face : faces) {
        const Vec3& a = positions[face[0]];
        const Vec3& c = positions[face[2]];
        six_volumes += a.dot(positions[face[1]].cross(c));
        if (corner_count(face) == 4) six_volumes += a.dot(c.cross(positions[face[3]]));
    }
    return six_volumes / 6;
}

std::vector<double> vertex_areas(const std::vector<Vec3>& positions, const std::vector<Face>& faces) {
    std::vector<double> areas(positions.size(), 0.0);
    for (const Face& face : faces) {
        const int corners = corner_count(face);
        const double share = 0.5 * twice_vector_area(positions, face).norm() / corners;
        for (int c = 0; c < corners; ++c) areas[face[c]] += share;
    }
    return areas;
}

}  // namespace windfall::geometry
