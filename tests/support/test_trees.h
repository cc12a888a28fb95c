#pragma once
// Trees for tests: swept tubes of any axis and cross-section, and a forked one, closed, with texture
// coordinates that have seams, normals and two materials.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "geometry/surface_mesh.h"
#include "meshfile/face_appender.h"
#include "meshfile/mesh.h"

namespace windfall::test {

using geometry::Vec2;
using geometry::Vec3;

/// Polygons with a texture coordinate at each corner.
struct TestTree {
    std::vector<Vec3> positions, normals;
    std::vector<std::vector<std::int32_t>> faces;
    std::vector<std::vector<Vec2>> uvs;
    std::vector<std::int32_t> materials;  ///< 0: "bark", 1: "moss", 2: "leaf"
};

inline void set_normals(TestTree& tree) {
    tree.normals.assign(tree.positions.size(), Vec3::Zero());
    for (const auto& face : tree.faces) {
        Vec3 area = Vec3::Zero();
        for (std::size_t k = 0; k < face.size(); ++k)
            area += tree.positions[static_cast<std::size_t>(face[k])].cross(
                tree.positions[static_cast<std::size_t>(face[(k + 1) % face.size()])]);
        for (const std::int32_t v : face) tree.normals[static_cast<std::size_t>(v)] += area;
    }
    for (Vec3& n : tree.normals) n.normalize();
}

/// How a tube is swept: `centre(t)` for t in 0 .. 1, half axes of the elliptic cross-section.
struct Tube {
    std::function<Vec3(double)> centre;
    std::function<Vec2(double)> half_axes;
    int rings = 24, sides = 16;
};

/// Quadrilaterals along the tube, u once around with a seam, and fans of triangles ("moss") at both ends.
inline TestTree tube_tree(const Tube& tube) {
    TestTree tree;
    Vec3 across = Vec3::UnitX();
    for (int i = 0; i <= tube.rings; ++i) {
        const double t = static_cast<double>(i) / tube.rings, e = 1e-4;
        const Vec3 along = (tube.centre(t + e) - tube.centre(t - e)).normalized();
        across = (across - across.dot(along) * along).normalized();
        const Vec3 third = along.cross(across);
        const Vec2 half = tube.half_axes(t);
        for (int k = 0; k < tube.sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / tube.sides;
            tree.positions.emplace_back(tube.centre(t) + half.x() * std::cos(angle) * across +
                                        half.y() * std::sin(angle) * third);
        }
    }
    const auto at = [&](int ring, int side) { return ring * tube.sides + side % tube.sides; };
    const auto uv = [&](int ring, int side) {
        return Vec2(static_cast<double>(side) / tube.sides, 3.0 * ring / tube.rings);
    };
    for (int i = 0; i < tube.rings; ++i)
        for (int k = 0; k < tube.sides; ++k) {
            tree.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
            tree.uvs.push_back({uv(i, k), uv(i, k + 1), uv(i + 1, k + 1), uv(i + 1, k)});
            tree.materials.push_back(0);
        }
    for (const int ring : {0, tube.rings}) {
        const auto middle = static_cast<std::int32_t>(tree.positions.size());
        tree.positions.push_back(tube.centre(ring == 0 ? 0 : 1));
        for (int k = 0; k < tube.sides; ++k) {
            const std::int32_t a = at(ring, k), b = at(ring, k + 1);
            tree.faces.push_back(ring == 0 ? std::vector<std::int32_t>{b, a, middle}
                                           : std::vector<std::int32_t>{a, b, middle});
            tree.uvs.push_back({Vec2(0, 0), Vec2(1, 0), Vec2(0.5, 0.5)});
            tree.materials.push_back(1);
        }
    }
    set_normals(tree);
    return tree;
}

/// A straight piece of a forked tree's skeleton.
struct Limb {
    Vec3 from, to;
    double from_radius, to_radius;
};

/// Distance to the limbs' surface, smoothly joined; negative inside.
inline double limb_distance(const std::vector<Limb>& limbs, const Vec3& p) {
    constexpr double kSharpness = 40;
    double sum = 0;
    for (const Limb& limb : limbs) {
        const Vec3 axis = limb.to - limb.from;
        const double t = std::clamp((p - limb.from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
        const double distance =
            (p - limb.from - t * axis).norm() - (1 - t) * limb.from_radius - t * limb.to_radius;
        sum += std::exp(-kSharpness * distance);
    }
    return -std::log(sum) / kSharpness;
}

/// The surface of joined limbs as quadrilaterals of about `cell` size (surface nets, Gibson 1998, put back
/// onto the surface). Texture: angle about and way along the nearest limb. Moss near the ground.
TestTree forked_tree(const std::vector<Limb>& limbs, double cell);

/// The trees in share/trees.
TestTree sample_forked_tree();
TestTree sample_bent_branch();

/// A trunk along +y of radius 0.16 that forks at height 2 into a bent branch to +x (radius 0.1) and a
/// straight one to -x (radius 0.08).
inline std::vector<Limb> fork_limbs() {
    return {{{0, 0, 0}, {0, 2, 0}, 0.17, 0.14},
            {{0, 2, 0}, {0.35, 2.5, 0}, 0.11, 0.1},
            {{0.35, 2.5, 0}, {0.8, 2.9, 0.1}, 0.1, 0.095},
            {{0.8, 2.9, 0.1}, {1.3, 3.15, 0.25}, 0.095, 0.085},
            {{1.3, 3.15, 0.25}, {1.8, 3.25, 0.4}, 0.085, 0.07},
            {{0, 2, 0}, {-0.9, 3.1, -0.2}, 0.09, 0.07}};
}

inline TestTree forked_tree(const std::vector<Limb>& limbs, double cell) {
    TestTree tree;
    Eigen::AlignedBox3d box;
    for (const Limb& limb : limbs)
        for (const Vec3& p : {limb.from, limb.to})
            for (const double side : {-1.0, 1.0})
                box.extend(Vec3(p + Vec3::Constant(side * (0.25 + 2 * cell))));
    const Eigen::Vector3i size = (box.sizes() / cell).cast<int>() + Eigen::Vector3i::Constant(2);
    const auto index = [&](int i, int j, int k) {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size.y()) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size.x()) +
               static_cast<std::size_t>(i);
    };
    // The offset keeps the grid's nodes off the symmetric places of the skeleton.
    const auto node = [&](int i, int j, int k) {
        return Vec3(box.min() + cell * Vec3(i + 0.123, j + 0.234, k + 0.345));
    };
    std::vector<double> value(static_cast<std::size_t>(size.prod()));
    for (int k = 0; k < size.z(); ++k)
        for (int j = 0; j < size.y(); ++j)
            for (int i = 0; i < size.x(); ++i) value[index(i, j, k)] = limb_distance(limbs, node(i, j, k));

    std::map<std::size_t, std::int32_t> vertex_of_cell;
    const auto vertex = [&](int i, int j, int k) {
        const auto [found, is_new] =
            vertex_of_cell.try_emplace(index(i, j, k), static_cast<std::int32_t>(tree.positions.size()));
        if (!is_new) return found->second;
        Vec3 p = node(i, j, k) + Vec3::Constant(0.5 * cell);
        for (int step = 0; step < 6; ++step) {
            Vec3 slope;
            for (int axis = 0; axis < 3; ++axis)
                slope[axis] = (limb_distance(limbs, p + 1e-5 * Vec3::Unit(axis)) -
                               limb_distance(limbs, p - 1e-5 * Vec3::Unit(axis))) /
                              2e-5;
            p -= limb_distance(limbs, p) * slope / slope.squaredNorm();
        }
        tree.positions.push_back(p);
        return found->second;
    };
    for (int k = 1; k + 1 < size.z(); ++k)
        for (int j = 1; j + 1 < size.y(); ++j)
            for (int i = 1; i + 1 < size.x(); ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    const Eigen::Vector3i step = Eigen::Vector3i::Unit(axis);
                    const bool inside = value[index(i, j, k)] < 0;
                    if (inside == (value[index(i + step.x(), j + step.y(), k + step.z())] < 0)) continue;
                    const Eigen::Vector3i b = -Eigen::Vector3i::Unit((axis + 1) % 3);
                    const Eigen::Vector3i c = -Eigen::Vector3i::Unit((axis + 2) % 3);
                    std::vector<std::int32_t> face{
                        vertex(i, j, k), vertex(i + b.x(), j + b.y(), k + b.z()),
                        vertex(i + b.x() + c.x(), j + b.y() + c.y(), k + b.z() + c.z()),
                        vertex(i + c.x(), j + c.y(), k + c.z())};
                    if (!inside) std::reverse(face.begin(), face.end());
                    tree.faces.push_back(std::move(face));
                }
    for (const auto& face : tree.faces) {
        Vec3 middle = Vec3::Zero();
        for (const std::int32_t v : face) middle += tree.positions[static_cast<std::size_t>(v)] / 4;
        std::size_t nearest = 0;
        for (std::size_t l = 1; l < limbs.size(); ++l)
            if (limb_distance({limbs[l]}, middle) < limb_distance({limbs[nearest]}, middle)) nearest = l;
        const Limb& limb = limbs[nearest];
        const Vec3 along = (limb.to - limb.from).normalized(), across = along.unitOrthogonal();
        const auto turn = [&](const Vec3& p) {
            return std::atan2((p - limb.from).dot(along.cross(across)), (p - limb.from).dot(across)) /
                   (2 * std::numbers::pi);
        };
        std::vector<Vec2> uv;
        for (const std::int32_t v : face) {
            const Vec3& p = tree.positions[static_cast<std::size_t>(v)];
            const double u = turn(middle) + std::remainder(turn(p) - turn(middle), 1.0);
            uv.emplace_back(u, 2 * (p - limb.from).dot(along) + static_cast<double>(nearest));
        }
        tree.uvs.push_back(std::move(uv));
        tree.materials.push_back(middle.y() < 0.5 ? 1 : 0);
    }
    set_normals(tree);
    return tree;
}

/// Adds leaves, single-sided cards of about `length`, on the outer halves of the thinnest limbs: bodies of
/// their own that only touch the bark. Their material is number 2, "leaf".
inline void add_leaves(TestTree& tree, const std::vector<Limb>& limbs, int count, double length) {
    std::vector<Limb> twigs;
    for (const Limb& limb : limbs)
        if (limb.to_radius < 0.09) twigs.push_back(limb);
    for (int i = 0; i < count; ++i) {
        const Limb& limb = twigs[static_cast<std::size_t>(i) % twigs.size()];
        // Evenly spread in two dimensions (Roberts 2018, the R2 sequence).
        const double t = 0.3 + 0.7 * std::fmod(0.7548776662 * i, 1.0);
        const double angle = 2 * std::numbers::pi * std::fmod(0.5698402910 * i, 1.0);
        const Vec3 along = (limb.to - limb.from).normalized(), across = along.unitOrthogonal();
        const Vec3 out = std::cos(angle) * across + std::sin(angle) * along.cross(across);
        const double radius = (1 - t) * limb.from_radius + t * limb.to_radius;
        const Vec3 foot = limb.from + t * (limb.to - limb.from) + 0.97 * radius * out;
        const Vec3 forth = (out + (0.8 * std::cos(7 * angle)) * along - 0.3 * Vec3::UnitY()).normalized();
        Vec3 side = 0.3 * length * forth.cross(along).normalized();
        if (side.cross(forth).y() < 0) side = -side;  // the upper side is the one that is seen
        const auto first = static_cast<std::int32_t>(tree.positions.size());
        for (const Vec3& p : {foot, Vec3(foot + 0.5 * length * forth - side), Vec3(foot + length * forth),
                              Vec3(foot + 0.5 * length * forth + side)})
            tree.positions.push_back(p);
        tree.faces.push_back({first, first + 1, first + 2, first + 3});
        tree.uvs.push_back({Vec2(0.5, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(0, 0.5)});
        tree.materials.push_back(2);
    }
    set_normals(tree);
}

inline TestTree sample_forked_tree() {
    TestTree tree = forked_tree(fork_limbs(), 0.035);
    add_leaves(tree, fork_limbs(), 160, 0.16);
    return tree;
}

inline TestTree sample_bent_branch() {
    Tube tube;
    tube.centre = [](double t) { return Vec3(0.3 * t * t, 2 * t, 0.2 * t); };
    tube.half_axes = [](double t) { return Vec2(0.14 - 0.03 * t, 0.09 - 0.02 * t); };
    return tube_tree(tube);
}

/// As a file would hold it: with `by_groups` as glTF does (a primitive for each material, vertices split at
/// seams, (0, 0) upper left), else as OBJ does.
inline meshfile::Mesh as_mesh(const TestTree& tree, bool by_groups) {
    using meshfile::Role;
    meshfile::Mesh empty;
    empty.materials = {{"bark", -1, {0.12F, 0.08F, 0.05F}, 0.9F}, {"moss", -1, {0.08F, 0.14F, 0.03F}, 0.9F}};
    if (std::find(tree.materials.begin(), tree.materials.end(), 2) != tree.materials.end())
        empty.materials.push_back({"leaf", -1, {0.06F, 0.22F, 0.03F}, 0.6F});
    if (by_groups) {
        empty.attributes = {{"NORMAL", Role::Normal, 3, {}, false, {}},
                            {"TEXCOORD_0", Role::TextureCoordinate, 2, {}, false, {}}};
        for (std::size_t m = 0; m < empty.materials.size(); ++m)
            empty.groups.push_back({"tree", empty.materials[m].name, -1, static_cast<int>(m)});
    } else {
        empty.attributes = {{"vn", Role::Normal, 3, {}, true, {}},
                            {"vt", Role::TextureCoordinate, 2, {}, true, {}}};
        empty.groups = {{"tree", ""}};
    }
    meshfile::MeshPart part{empty, {}, {}};
    // The first vertex says that vertices belong to groups.
    if (by_groups) {
        part.mesh.vertex_groups.push_back(0);
        part.mesh.positions.emplace_back(Vec3::Zero());
        part.mesh.attributes[0].values.assign(3, 0);
        part.mesh.attributes[1].values.assign(2, 0);
    }
    meshfile::FaceAppender appender(part, empty);
    for (const Vec3& p : tree.positions) appender.add_place(p);
    for (std::size_t f = 0; f < tree.faces.size(); ++f) {
        std::vector<std::array<double, 5>> values;
        for (std::size_t k = 0; k < tree.faces[f].size(); ++k) {
            const Vec3& n = tree.normals[static_cast<std::size_t>(tree.faces[f][k])];
            const Vec2& uv = tree.uvs[f][k];
            values.push_back({n.x(), n.y(), n.z(), uv.x(), by_groups ? 1 - uv.y() : uv.y()});
        }
        std::vector<meshfile::NewCorner> corners;
        for (std::size_t k = 0; k < values.size(); ++k)
            corners.push_back({-1, tree.faces[f][k], values[k].data()});
        const meshfile::FaceInfo info{by_groups ? tree.materials[f] : 0, tree.materials[f],
                                      by_groups ? 0U : 1U};
        appender.add_face(info, corners, -1);
    }
    // Without the vertex that stood for the rest.
    return by_groups ? meshfile::part_of(part.mesh, std::vector<bool>(part.mesh.face_count(), true), {}).mesh
                     : part.mesh;
}

}  // namespace windfall::test
