#include "geometry/triangle_surface.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace windfall::geometry {

namespace {

void check_numbers(const SurfaceMesh& mesh) {
    const auto count = static_cast<std::int32_t>(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (!mesh.positions[v].allFinite())
            throw InputError(fmt::format("vertex {} has no finite position; export the mesh again", v));
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (int c = 0; c < corner_count(mesh.faces[f]); ++c)
            if (mesh.faces[f][c] < 0 || mesh.faces[f][c] >= count)
                throw InputError(
                    fmt::format("face {} points to vertex {}, and there are {}; export the mesh again", f,
                                mesh.faces[f][c], count));
}

/// For every used vertex the first vertex (by number) of its place.
std::vector<std::int32_t> first_at_place(const std::vector<Vec3>& positions, std::vector<std::int32_t> used) {
    std::vector<std::int32_t> parent(positions.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    const double distance = kWeldingDistance * diagonal_of(positions);
    std::sort(used.begin(), used.end(), [&](std::int32_t a, std::int32_t b) {
        return positions[a].x() != positions[b].x() ? positions[a].x() < positions[b].x() : a < b;
    });
    for (std::size_t i = 0; i < used.size(); ++i)
        for (std::size_t j = i + 1; j < used.size(); ++j) {
            const Vec3& a = positions[used[i]];
            const Vec3& b = positions[used[j]];
            if (b.x() - a.x() > distance) break;
            if ((b - a).squaredNorm() > distance * distance) continue;
            const std::int32_t one = root(used[i]), other = root(used[j]);
            parent[std::max(one, other)] = std::min(one, other);
        }
    for (const std::int32_t v : used) parent[v] = root(v);
    return parent;
}

Vec3 twice_area_of(const std::vector<Vec3>& positions, const Triangle& t) {
    return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
}

using Corners = std::array<std::uint8_t, 3>;

/// The two ways to cut a quadrilateral.
constexpr std::array<std::array<Corners, 2>, 2> kCuts = {
    {{{{0, 1, 2}, {0, 2, 3}}}, {{{1, 2, 3}, {1, 3, 0}}}}};

int better_cut(const std::vector<Vec3>& positions, const Face& face) {
    const Vec3 whole =
        (positions[face[2]] - positions[face[0]]).cross(positions[face[3]] - positions[face[1]]).normalized();
    std::array<double, 2> least{};
    for (int cut = 0; cut < 2; ++cut) {
        const auto part = [&](int k) {
            const Corners& c = kCuts[cut][k];
            return twice_area_of(positions, {face[c[0]], face[c[1]], face[c[2]]}).normalized().dot(whole);
        };
        least[cut] = std::min(part(0), part(1));
    }
    // The first one unless it is clearly worse: rounding shall not choose.
    return least[1] > least[0] + 1e-3 ? 1 : 0;
}

/// Places all of whose triangles were left out.
void leave_out_unused(TriangleSurface& surface) {
    std::vector<std::int32_t> number(surface.positions.size(), kNoVertex);
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t v : t) number[v] = 0;
    std::int32_t count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == kNoVertex) continue;
        surface.positions[count] = surface.positions[v];
        number[v] = count++;
    }
    surface.positions.resize(count);
    for (Triangle& t : surface.triangles)
        for (std::int32_t& v : t) v = number[v];
    for (std::int32_t& v : surface.vertex_of)
        if (v != kNoVertex) v = number[v];
}

}  // namespace

double diagonal_of(const std::vector<Vec3>& points) {
    if (points.empty()) return 0;
    Vec3 low = points[0], high = points[0];
    for (const Vec3& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).norm();
}

TriangleSurface welded_triangles(const SurfaceMesh& mesh) {
    check_numbers(mesh);
    std::vector<char> is_used(mesh.positions.size(), 0);
    for (const Face& face : mesh.faces)
        for (int c = 0; c < corner_count(face); ++c) is_used[face[c]] = 1;
    std::vector<std::int32_t> used;
    for (std::size_t v = 0; v < is_used.size(); ++v)
        if (is_used[v] != 0) used.push_back(static_cast<std::int32_t>(v));
    const std::vector<std::int32_t> first = first_at_place(mesh.positions, used);

    TriangleSurface surface;
    surface.vertex_of.assign(mesh.positions.size(), kNoVertex);
    for (const std::int32_t v : used) {
        if (first[v] == v) {
            surface.vertex_of[v] = static_cast<std::int32_t>(surface.positions.size());
            surface.positions.push_back(mesh.positions[v]);
        } else {
            surface.vertex_of[v] = surface.vertex_of[first[v]];
        }
    }
    const auto add = [&](std::size_t f, const Corners& corners) {
        Triangle t{};
        for (int k = 0; k < 3; ++k) t[k] = surface.vertex_of[mesh.faces[f][corners[k]]];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
        surface.triangles.push_back(t);
        surface.origin.push_back({static_cast<std::int32_t>(f), corners});
    };
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (corner_count(mesh.faces[f]) == 3) {
            add(f, {0, 1, 2});
        } else {
            for (const Corners& corners : kCuts[better_cut(mesh.positions, mesh.faces[f])]) add(f, corners);
        }
    }
    leave_out_unused(surface);
    return surface;
}

std::vector<Vec3> vertex_normals(const TriangleSurface& surface) {
    std::vector<Vec3> normals(surface.positions.size(), Vec3::Zero());
    for (const Triangle& t : surface.triangles) {
        const Vec3 area = twice_area_of(surface.positions, t);
        for (const std::int32_t v : t) normals[v] += area;
    }
    for (Vec3& normal : normals) normal.normalize();
    return normals;
}

}  // namespace windfall::geometry
