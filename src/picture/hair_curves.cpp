#include "picture/hair_curves.h"

#include <algorithm>

namespace windfall::picture {
namespace {

/// Light goes on through hair and lights it from within, so a strand is shaded more like the fur it is part
/// of than like a rod: by so much of the fur's own direction.
constexpr float kFurShare = 0.5F;

const Finish& hair_finish() {
    static const Finish finish = [] {
        Finish dull;
        dull.gloss = 0;
        return dull;
    }();
    return finish;
}

bool is_ball(const SceneHair& hair, std::size_t strand) {
    const auto points_a_strand = static_cast<std::size_t>(hair.points_per_strand);
    const Vec3f &root = hair.points[strand * points_a_strand],
                &tip = hair.points[(strand + 1) * points_a_strand - 1];
    return (tip - root).norm() < hair.radii[strand];
}

/// Embree's cones come out as long rods when they are shorter than wide, so heads are spheres.
bool are_balls(const SceneHair& hair) {
    if (hair.points_per_strand != 2) return false;
    for (std::size_t strand = 0; strand < hair.radii.size(); ++strand)
        if (!is_ball(hair, strand)) return false;
    return true;
}

void put_vertex(float* vertices, std::size_t i, const Vec3f& place, float radius) {
    for (int k = 0; k < 3; ++k) vertices[4 * i + static_cast<std::size_t>(k)] = place[k];
    vertices[4 * i + 3] = radius;
}

float* new_vertices(RTCGeometry geometry, std::size_t count) {
    return static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                       4 * sizeof(float), count));
}

RTCGeometry new_balls(RTCDevice device, const SceneHair& hair) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (float* vertices = new_vertices(geometry, hair.radii.size()))
        for (std::size_t strand = 0; strand < hair.radii.size(); ++strand)
            put_vertex(vertices, strand, (hair.points[2 * strand] + hair.points[2 * strand + 1]) / 2,
                       hair.radii[strand]);
    return geometry;
}

RTCGeometry new_strands(RTCDevice device, const SceneHair& hair) {
    const auto points_a_strand = static_cast<std::size_t>(hair.points_per_strand);
    const std::size_t segments = hair.radii.size() * (points_a_strand - 1);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    float* vertices = new_vertices(geometry, hair.points.size());
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(std::uint32_t), segments));
    if (vertices == nullptr || indices == nullptr) return geometry;
    for (std::size_t i = 0; i < hair.points.size(); ++i)
        put_vertex(vertices, i, hair.points[i], hair.radii[i / points_a_strand]);
    for (std::size_t i = 0; i < segments; ++i)
        indices[i] = static_cast<std::uint32_t>(i + i / (points_a_strand - 1));
    return geometry;
}

}  // namespace

void attach_hair(RTCDevice device, RTCScene scene, const SceneHair& hair, unsigned id) {
    if (hair.radii.empty()) return;
    RTCGeometry geometry = are_balls(hair) ? new_balls(device, hair) : new_strands(device, hair);
    rtcSetGeometryMask(geometry, kHairMask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

SurfacePoint hair_point(const SceneHair& hair, unsigned segment, const Vec3f& place, float distance,
                        const Vec3f& geometric_normal, const Vec3f& direction) {
    const auto points_a_strand = static_cast<std::size_t>(hair.points_per_strand);
    const std::size_t strand = segment / (points_a_strand - 1);
    const Vec3f& root = hair.points[strand * points_a_strand];
    const Vec3f& tip = hair.points[(strand + 1) * points_a_strand - 1];
    Vec3f round = geometric_normal.normalized();
    if (round.dot(direction) > 0) round = -round;
    SurfacePoint point;
    point.finish = &hair_finish();
    point.gloss = 0;
    point.distance = distance;
    point.place = place;
    point.albedo = hair.colours[strand];
    const float fur = is_ball(hair, strand) ? 0 : kFurShare;
    const Vec3f along = (tip - root).normalized();
    Vec3f normal = fur * along + (1 - fur) * round;
    // seen from below the fur is lit like its other side
    if (const float away = normal.dot(direction); away > -0.05F) normal -= (away + 0.05F) * direction;
    point.normal = point.face_normal = normal.normalized();
    point.start = place + 2.5F * hair.radii[strand] * point.normal;
    return point;
}

}  // namespace windfall::picture
