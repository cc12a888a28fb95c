#include "geometry/surface_transfer.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/triangle_tree.h"

namespace windfall::geometry {

namespace {

constexpr double kPhongShare = 0.5;
constexpr int kInverseBilinearSteps = 6;
constexpr std::size_t kVerticesPerBlock = 2048;

/// A quadrilateral of the skin at one moment.
struct Patch {
    std::array<Vec3, 4> x, normal;

    Vec3 flat(double u, double v) const {
        return (1 - v) * ((1 - u) * x[0] + u * x[1]) + v * ((1 - u) * x[3] + u * x[2]);
    }
    Vec3 along_u(double v) const { return (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]); }
    Vec3 along_v(double u) const { return (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]); }

    /// Length by which a small shape on the patch is scaled when the patch's own area changes.
    double scale(double u, double v) const { return std::sqrt(along_u(v).cross(along_v(u)).norm()); }

    /// The place on the curved skin and its frame: columns two tangents and the normal.
    std::pair<Vec3, Eigen::Matrix3d> curved(double u, double v) const {
        const std::array<double, 4> weight{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
        const Vec3 p = flat(u, v);
        Vec3 lift = Vec3::Zero(), n = Vec3::Zero();
        for (int c = 0; c < 4; ++c) {
            lift -= weight[c] * normal[c].dot(p - x[c]) * normal[c];
            n += weight[c] * normal[c];
        }
        n.normalize();
        // Between both directions of the patch, so that neither shear nor stretch turns the frame more than
        // half of what it turns them.
        const Vec3 middle = along_u(v).normalized() + along_v(u).normalized();
        Eigen::Matrix3d frame;
        frame.col(2) = n;
        frame.col(0) = (middle - n.dot(middle) * n).normalized();
        frame.col(1) = n.cross(frame.col(0));
        return {p + kPhongShare * lift, frame};
    }
};

Patch patch_of(const Quad& quad, const std::vector<Vec3>& skin, const std::vector<Vec3>& normals) {
    Patch patch;
    for (int c = 0; c < 4; ++c) {
        patch.x[c] = skin[quad[c]];
        patch.normal[c] = normals[quad[c]];
    }
    return patch;
}

/// The (u, v) of the flat patch nearest to a point, from a first guess (Gauss-Newton).
Vec2 nearest_uv(const Patch& patch, const Vec3& point, Vec2 uv) {
    for (int k = 0; k < kInverseBilinearSteps; ++k) {
        const Vec3 du = patch.along_u(uv.y()), dv = patch.along_v(uv.x());
        const Vec3 miss = point - patch.flat(uv.x(), uv.y());
        Eigen::Matrix2d normal_matrix;
        normal_matrix << du.dot(du), du.dot(dv), du.dot(dv), dv.dot(dv);
        const double determinant = normal_matrix.determinant();
        if (!(determinant > 1e-12 * du.squaredNorm() * dv.squaredNorm())) break;
        uv += normal_matrix.inverse() * Vec2(du.dot(miss), dv.dot(miss));
        uv = uv.cwiseMax(0.0).cwiseMin(1.0);
    }
    return uv;
}

struct Skin {
    std::vector<Vec3> x, normals;
};

Skin skin_of(const std::vector<Eigen::Vector3f>& positions, const std::vector<Quad>& quads) {
    Skin skin;
    skin.x.reserve(positions.size());
    for (const auto& p : positions) skin.x.emplace_back(p.cast<double>());
    skin.normals = vertex_normals(skin.x, {quads.begin(), quads.end()});
    return skin;
}

double mean_edge(const std::vector<Vec3>& x, const std::vector<Quad>& quads) {
    double sum = 0;
    for (const Quad& quad : quads)
        for (int c = 0; c < 4; ++c) sum += (x[quad[(c + 1) % 4]] - x[quad[c]]).norm();
    return sum / (4.0 * static_cast<double>(quads.size()));
}

}  // namespace

SurfaceTransfer::SurfaceTransfer(const std::vector<Vec3>& vertices, const std::vector<Vec3>& normals,
                                 const std::vector<Eigen::Vector3f>& skin, std::vector<Quad> quads)
    : m_skin_vertices(skin.size()), m_quads(std::move(quads)), m_bonds(vertices.size()) {
    if (normals.size() != vertices.size() || m_quads.empty())
        throw InputError(
            fmt::format("{} normals for {} vertices and a skin of {} faces: one normal each and a "
                        "skin are needed",
                        normals.size(), vertices.size(), m_quads.size()));
    const Skin rest = skin_of(skin, m_quads);
    std::vector<Triangle> triangles;
    triangles.reserve(2 * m_quads.size());
    for (const Quad& q : m_quads) triangles.insert(triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
    const TriangleTree tree(rest.x, triangles);
    const double furthest = mean_edge(rest.x, m_quads);
    std::vector<double> distances(vertices.size());
    parallel_blocks(vertices.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            // Across a thin part or a crease the other side may be nearer.
            auto nearest = tree.nearest(vertices[i], normals[i]);
            if (!(nearest.distance_sq <= furthest * furthest)) nearest = tree.nearest(vertices[i]);
            const Vec3& w = nearest.place.weights;
            const bool upper = nearest.place.triangle % 2 == 1;  // corners 0, 2, 3 instead of 0, 1, 2
            Bond& bond = m_bonds[i];
            bond.quad = nearest.place.triangle / 2;
            const Patch patch = patch_of(m_quads[bond.quad], rest.x, rest.normals);
            const Vec2 first = upper ? Vec2(w[1], w[1] + w[2]) : Vec2(w[1] + w[2], w[2]);
            const Vec2 uv = nearest_uv(patch, vertices[i], first);
            bond.u = static_cast<float>(uv.x());
            bond.v = static_cast<float>(uv.y());
            const auto [place, frame] = patch.curved(bond.u, bond.v);
            const double scale = patch.scale(bond.u, bond.v);
            const Vec3 offset =
                scale > 0 ? Vec3(frame.transpose() * (vertices[i] - place) / scale) : Vec3::Zero();
            bond.offset = offset.cast<float>();
            distances[i] = std::sqrt(nearest.distance_sq);
        }
    });
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        m_largest_offset_m = std::max(m_largest_offset_m, distances[i]);
        if (distances[i] <= furthest) continue;
        throw InputError(
            fmt::format("vertex {} at ({:.4g}, {:.4g}, {:.4g}) m lies {:.2g} m from the skin, further "
                        "than its mean edge of {:.2g} m: give the skin more cells",
                        i, vertices[i].x(), vertices[i].y(), vertices[i].z(), distances[i], furthest));
    }
}

std::vector<Eigen::Vector3f> SurfaceTransfer::moved(const std::vector<Eigen::Vector3f>& skin) const {
    if (skin.size() != m_skin_vertices)
        throw InputError(fmt::format("a skin of {} vertices cannot move what is bound to {}", skin.size(),
                                     m_skin_vertices));
    const Skin now = skin_of(skin, m_quads);
    std::vector<Eigen::Vector3f> result(m_bonds.size());
    parallel_blocks(m_bonds.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Bond& bond = m_bonds[i];
            const Patch patch = patch_of(m_quads[bond.quad], now.x, now.normals);
            const auto [place, frame] = patch.curved(bond.u, bond.v);
            const Vec3 offset = frame * bond.offset.cast<double>();
            result[i] = (place + patch.scale(bond.u, bond.v) * offset).cast<float>();
        }
    });
    return result;
}

std::vector<float> SurfaceTransfer::carried(const std::vector<float>& values) const {
    if (values.size() != m_skin_vertices)
        throw InputError(fmt::format("{} values on a skin of {} vertices", values.size(), m_skin_vertices));
    std::vector<float> result;
    result.reserve(m_bonds.size());
    for (const Bond& bond : m_bonds) {
        const Quad& q = m_quads[bond.quad];
        const float below = (1 - bond.u) * values[q[0]] + bond.u * values[q[1]];
        const float above = (1 - bond.u) * values[q[3]] + bond.u * values[q[2]];
        result.push_back((1 - bond.v) * below + bond.v * above);
    }
    return result;
}

}  // namespace windfall::geometry
