#include "fracture/tree_rays.h"

#include <fmt/format.h>

#include <limits>

#include "core/error.h"
#include "fracture/tree_text.h"
#include "geometry/embree_scene.h"

namespace windfall::fracture {

using geometry::Vec3;

struct TreeRays::Scene {
    RTCDevice device = geometry::new_embree_device();
    RTCScene scene = nullptr;

    Scene() = default;
    ~Scene() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
};

TreeRays::TreeRays(const TreeSurface& surface, std::vector<std::int32_t> triangles, const Vec3& origin,
                   double unit)
    : m_surface(surface),
      m_triangles(std::move(triangles)),
      m_origin(origin),
      m_unit(unit),
      m_scene(std::make_unique<Scene>()) {
    if (m_scene->device == nullptr) throw RunError("Embree, which finds the bark, did not start");
    m_scene->scene = rtcNewScene(m_scene->device);
    // No ray may slip through between two triangles.
    rtcSetSceneFlags(m_scene->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(m_scene->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * m_triangles.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), m_triangles.size()));
    if (vertices == nullptr || indices == nullptr)
        throw RunError("there is not enough memory for the branch");
    for (std::size_t i = 0; i < m_triangles.size(); ++i) {
        const TreeTriangle& triangle = surface.triangles[static_cast<std::size_t>(m_triangles[i])];
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = (surface.corner(triangle, k) - origin) / unit;
            for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
            *indices++ = static_cast<unsigned>(3 * i + k);
        }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(m_scene->scene, geometry);
    rtcReleaseGeometry(geometry);
    geometry::commit_scene(m_scene->scene);
}

TreeRays::~TreeRays() = default;

SurfacePlace TreeRays::hit(const Vec3& from, const Vec3& direction) const {
    const Vec3 start = (from - m_origin) / m_unit;
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(start.x());
    ray.ray.org_y = static_cast<float>(start.y());
    ray.ray.org_z = static_cast<float>(start.z());
    ray.ray.dir_x = static_cast<float>(direction.x());
    ray.ray.dir_y = static_cast<float>(direction.y());
    ray.ray.dir_z = static_cast<float>(direction.z());
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(m_scene->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        throw InputError(
            fmt::format("the bark has a hole beside {}; close it and export the tree again", text_of(from)));
    SurfacePlace place;
    place.triangle = m_triangles[ray.hit.primID];
    place.weights = Vec3(1.0 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v);
    const TreeTriangle& triangle = m_surface.triangles[static_cast<std::size_t>(place.triangle)];
    for (std::size_t k = 0; k < 3; ++k)
        place.position += place.weights[static_cast<int>(k)] * m_surface.corner(triangle, k);
    return place;
}

}  // namespace windfall::fracture
