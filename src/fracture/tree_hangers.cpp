#include "fracture/tree_hangers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "geometry/embree_scene.h"

namespace windfall::fracture {
namespace {

using geometry::Vec3;

/// Nearest triangles among those of larger bodies, with Embree's point queries.
class NearestBody {
  public:
    NearestBody(const TreeSurface& surface, const std::vector<double>& sizes)
        : m_surface(surface), m_sizes(sizes) {
        m_device = geometry::new_embree_device();
        if (m_device == nullptr) throw RunError("Embree, which finds what leaves hang on, did not start");
        m_scene = rtcNewScene(m_device);
        RTCGeometry geometry = rtcNewGeometry(m_device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                     RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                                     surface.positions.size()));
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                       RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                                       surface.triangles.size()));
        if (vertices == nullptr || indices == nullptr)
            throw RunError("there is not enough memory for the tree");
        for (const Vec3& p : surface.positions)
            for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
        for (const TreeTriangle& triangle : surface.triangles)
            for (const std::int32_t v : triangle.vertices) *indices++ = static_cast<unsigned>(v);
        rtcSetGeometryPointQueryFunction(geometry, consider);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(m_scene, geometry);
        rtcReleaseGeometry(geometry);
        geometry::commit_scene(m_scene);
    }
    ~NearestBody() {
        rtcReleaseScene(m_scene);
        rtcReleaseDevice(m_device);
    }
    NearestBody(const NearestBody&) = delete;
    NearestBody& operator=(const NearestBody&) = delete;

    /// Looks around `point`; keeps what is nearer than what was found before.
    void look(const Vec3& point, double least_size) {
        m_point = point;
        m_least_size = least_size;
        RTCPointQuery query{static_cast<float>(point.x()), static_cast<float>(point.y()),
                            static_cast<float>(point.z()), 0, static_cast<float>(m_distance)};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(m_scene, &query, &context, nullptr, this);
    }
    void forget() {
        m_found = {};
        m_distance = std::numeric_limits<float>::infinity();
    }
    const SurfacePlace& found() const { return m_found; }

  private:
    static bool consider(RTCPointQueryFunctionArguments* arguments) {
        auto& self = *static_cast<NearestBody*>(arguments->userPtr);
        const auto t = static_cast<std::int32_t>(arguments->primID);
        const std::int32_t vertex = self.m_surface.triangles[arguments->primID].vertices[0];
        const std::int32_t body = self.m_surface.component[static_cast<std::size_t>(vertex)];
        if (self.m_sizes[static_cast<std::size_t>(body)] < self.m_least_size) return false;
        const SurfacePlace place = nearest_place(self.m_surface, t, self.m_point);
        const double distance = (place.position - self.m_point).norm();
        if (distance >= self.m_distance) return false;
        self.m_distance = distance;
        self.m_found = place;
        arguments->query->radius = static_cast<float>(distance);
        return true;
    }

    const TreeSurface& m_surface;
    const std::vector<double>& m_sizes;
    RTCDevice m_device = nullptr;
    RTCScene m_scene = nullptr;
    Vec3 m_point = Vec3::Zero();
    double m_least_size = 0;
    double m_distance = std::numeric_limits<float>::infinity();
    SurfacePlace m_found;
};

std::vector<std::vector<std::int32_t>> vertices_of_bodies(const TreeSurface& surface) {
    std::vector<std::vector<std::int32_t>> bodies(static_cast<std::size_t>(surface.components));
    for (std::size_t v = 0; v < surface.component.size(); ++v)
        bodies[static_cast<std::size_t>(surface.component[v])].push_back(static_cast<std::int32_t>(v));
    return bodies;
}

std::vector<double> sizes_of(const TreeSurface& surface,
                             const std::vector<std::vector<std::int32_t>>& bodies) {
    std::vector<double> sizes;
    for (const auto& body : bodies) {
        Eigen::AlignedBox3d box;
        for (const std::int32_t v : body) box.extend(surface.positions[static_cast<std::size_t>(v)]);
        sizes.push_back(box.diagonal().norm());
    }
    return sizes;
}

}  // namespace

void assign_hangers(const TreeSurface& surface, const TreeBranch& branch, const BranchAxis& axis,
                    BranchCut& cut) {
    if (surface.components == 1) return;
    const auto bodies = vertices_of_bodies(surface);
    const std::vector<double> sizes = sizes_of(surface, bodies);
    NearestBody nearest(surface, sizes);
    // What a body hangs on is larger, and has its side before.
    std::vector<std::size_t> order(bodies.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    for (const std::size_t body : order) {
        if (static_cast<std::int32_t>(body) == branch.component) continue;
        nearest.forget();
        // A leaf has few vertices; of a large body some will do.
        const std::size_t step = 1 + bodies[body].size() / 200;
        for (std::size_t i = 0; i < bodies[body].size(); i += step)
            nearest.look(surface.positions[static_cast<std::size_t>(bodies[body][i])], 2 * sizes[body]);
        TreeSide side = TreeSide::Tree;
        if (nearest.found().triangle >= 0) {
            const TreeTriangle& triangle =
                surface.triangles[static_cast<std::size_t>(nearest.found().triangle)];
            side = cut.sides[static_cast<std::size_t>(triangle.vertices[0])];
            const bool of_branch =
                surface.component[static_cast<std::size_t>(triangle.vertices[0])] == branch.component;
            const double height = of_branch ? axis.height_of(nearest.found().position) : 0;
            // A long triangle may reach through the whole break: its vertices do not tell the side.
            const bool is_beside =
                (nearest.found().position - axis.at(height).centre).norm() < 3 * branch.radius;
            if (of_branch && is_beside && height > axis.lowest() && height < axis.highest())
                side = height > 0.5 * (cut.low + cut.high) ? TreeSide::Piece : TreeSide::Tree;
        }
        for (const std::int32_t v : bodies[body]) cut.sides[static_cast<std::size_t>(v)] = side;
    }
}

}  // namespace windfall::fracture
