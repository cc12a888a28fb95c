#include "picture/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "geometry/embree_scene.h"
#include "picture/hair_curves.h"
#include "picture/texture_lookup.h"

namespace windfall::picture {

struct Surfaces::Handles {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
    void check() const {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE)
            throw RunError(fmt::format("Embree failed with error {}", static_cast<int>(error)));
    }
};

namespace {

/// Cosine between the normals of a facet and of its corner from which on the two belong to one smooth
/// surface.
constexpr float kSmooth = 0.7F;
/// Cosine between the normals of a quadrilateral and its triangles above which it counts as flat.
constexpr float kFlat = 0.9F;

void attach(RTCDevice device, RTCScene scene, const SceneMesh& mesh, unsigned id) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
    auto* quads = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), mesh.quads.size()));
    if (vertices != nullptr && quads != nullptr) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            std::memcpy(vertices + 3 * v, mesh.positions[v].data(), 3 * sizeof(float));
        std::memcpy(quads, mesh.quads.data(), mesh.quads.size() * sizeof(mesh.quads[0]));
        rtcSetGeometryMask(geometry, kMeshMask);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
    }
    rtcReleaseGeometry(geometry);
}

RTCRay to_embree(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x();
    r.org_y = ray.origin.y();
    r.org_z = ray.origin.z();
    r.dir_x = ray.direction.x();
    r.dir_y = ray.direction.y();
    r.dir_z = ray.direction.z();
    r.tnear = ray.from;
    r.tfar = ray.to;
    r.mask = kMeshMask | kHairMask;
    return r;
}

/// A smooth normal that is of use: over the facet, and towards the eye where the facet is. On needles and at
/// the feet of steep steps the normals of the vertices look away from either, and the facet would be black.
Vec3f seen_normal(const Vec3f& smooth, const Vec3f& face_normal, const Vec3f& to_eye) {
    constexpr float kLeastCosine = 0.05F;
    Vec3f normal = smooth;
    for (const Vec3f& side : {face_normal, to_eye}) {
        const float cosine = normal.dot(side);
        if (cosine < kLeastCosine && face_normal.dot(side) > 0)
            normal = (normal + (kLeastCosine - cosine) * side).normalized();
    }
    return normal;
}

}  // namespace

Surfaces::Surfaces(const Scene& scene) : m_scene(scene), m_handles(std::make_unique<Handles>()) {
    m_handles->device = geometry::new_embree_device();
    if (m_handles->device == nullptr) m_handles->check();
    m_handles->scene = rtcNewScene(m_handles->device);
    rtcSetSceneBuildQuality(m_handles->scene, RTC_BUILD_QUALITY_HIGH);
    m_low = Vec3f::Constant(1e30F);
    m_high = -m_low;
    for (unsigned id = 0; id < scene.meshes.size(); ++id) {
        if (scene.meshes[id].quads.empty()) continue;
        attach(m_handles->device, m_handles->scene, scene.meshes[id], id);
        m_handles->check();
        for (const Vec3f& p : scene.meshes[id].positions) {
            m_low = m_low.cwiseMin(p);
            m_high = m_high.cwiseMax(p);
        }
    }
    for (std::size_t i = 0; i < scene.hair.size(); ++i) {
        attach_hair(m_handles->device, m_handles->scene, scene.hair[i],
                    static_cast<unsigned>(scene.meshes.size() + i));
        m_handles->check();
        for (std::size_t k = 0; k < scene.hair[i].points.size(); ++k) {
            const Vec3f& p = scene.hair[i].points[k];
            const Vec3f thick = Vec3f::Constant(
                scene.hair[i].radii[k / static_cast<std::size_t>(scene.hair[i].points_per_strand)]);
            m_low = m_low.cwiseMin(p - thick);
            m_high = m_high.cwiseMax(p + thick);
        }
    }
    m_lift = 2e-5F * std::max(m_low.cwiseAbs().maxCoeff(), m_high.cwiseAbs().maxCoeff());
    geometry::commit_scene(m_handles->scene);
    m_handles->check();
}

Surfaces::~Surfaces() = default;

/// Most rays from the floor go nowhere near the surfaces; this spares them the call.
bool Surfaces::misses_bounds(const Ray& ray) const {
    float near = ray.from, far = ray.to;
    for (int k = 0; k < 3; ++k) {
        const float inverse = 1 / ray.direction[k];
        const float a = (m_low[k] - m_lift - ray.origin[k]) * inverse;
        const float b = (m_high[k] + m_lift - ray.origin[k]) * inverse;
        // in this order a NaN (a ray in the plane of a side) leaves the range as it is
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near > far;
}

std::optional<SurfacePoint> Surfaces::first_hit(const Ray& ray) const {
    if (misses_bounds(ray)) return std::nullopt;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit{};
    hit.ray = to_embree(ray);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(m_handles->scene, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    if (hit.hit.geomID >= m_scene.meshes.size())
        return hair_point(m_scene.hair[hit.hit.geomID - m_scene.meshes.size()], hit.hit.primID,
                          ray.origin + hit.ray.tfar * ray.direction, hit.ray.tfar,
                          Vec3f(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z), ray.direction);
    const SceneMesh& mesh = m_scene.meshes[hit.hit.geomID];
    const auto& quad = mesh.quads[hit.hit.primID];
    // Embree cuts a quadrilateral into the triangles 0 1 3 and 2 3 1
    const float u = hit.hit.u, v = hit.hit.v;
    const bool first = u + v <= 1;
    const std::array<std::uint32_t, 3> corners =
        first ? std::array{quad[0], quad[1], quad[3]} : std::array{quad[2], quad[3], quad[1]};
    const std::array<float, 3> weights =
        first ? std::array{1 - u - v, u, v} : std::array{u + v - 1, 1 - u, 1 - v};
    SurfacePoint point;
    point.distance = hit.ray.tfar;
    point.mesh = &mesh;
    point.corners = corners;
    point.weights = weights;
    point.finish = &mesh.finishes[mesh.quad_finishes.empty() ? 0 : mesh.quad_finishes[hit.hit.primID]];
    point.roughness = point.finish->roughness;
    point.gloss = point.finish->gloss;
    point.scatter = point.finish->scatter;
    point.place = point.normal = point.albedo = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        point.place += weights[k] * mesh.positions[corners[k]];
        point.normal += weights[k] * mesh.normals[corners[k]];
        if (!mesh.texture) point.albedo += weights[k] * mesh.albedo[corners[k]];
    }
    if (mesh.texture) {
        const auto& uvs = mesh.quad_uvs[hit.hit.primID];
        point.corner_uvs = first ? std::array{uvs[0], uvs[1], uvs[3]} : std::array{uvs[2], uvs[3], uvs[1]};
        for (std::size_t k = 0; k < 3; ++k) point.uv += weights[k] * point.corner_uvs[k];
        point.albedo = texture_colour(mesh.texture->base_color, point.uv);
    }
    const Vec3f& origin = mesh.positions[corners[0]];
    point.face_normal =
        (mesh.positions[corners[1]] - origin).cross(mesh.positions[corners[2]] - origin).normalized();
    if (point.finish->hard) {
        // of the whole quadrilateral, so that its diagonal is not seen, unless it is bent
        const Vec3f whole = facet_area(mesh.positions, quad).normalized();
        point.normal = whole.dot(point.face_normal) > kFlat ? whole : point.face_normal;
        point.start = point.place + m_lift * point.face_normal;
        return point;
    }
    point.normal = seen_normal(point.normal.normalized(), point.face_normal, -ray.direction);
    // Hanika, "Hacking the shadow terminator" (2021): start from the tangent planes at the corners, not from
    // the facet.
    point.start = point.place + m_lift * point.face_normal;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3f& n = mesh.normals[corners[k]];
        // A tangent plane that is steep against the facet would lift the start into what stands next to it.
        if (n.dot(point.face_normal) < kSmooth) continue;
        point.start -= weights[k] * std::min(0.0F, (point.place - mesh.positions[corners[k]]).dot(n)) * n;
    }
    return point;
}

bool Surfaces::blocked(const Ray& ray) const {
    if (misses_bounds(ray)) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = to_embree(ray);
    r.mask = kMeshMask;
    rtcOccluded1(m_handles->scene, &context, &r);
    return r.tfar < 0;
}

}  // namespace windfall::picture
