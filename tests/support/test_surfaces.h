#pragma once
// Fruit as an artist would hand them in: closed meshes with texture coordinates, made by formula. Lengths in
// m.
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::test {

using geometry::Face;
using geometry::SurfaceMesh;
using geometry::Vec2;
using geometry::Vec3;

/// A point of a surface for a longitude in [0, 2 pi) and a place from the lower (0) to the upper pole (1).
using RoundSurface = std::function<Vec3(double longitude, double along)>;

/// Quadrilaterals between `columns` meridians and `rows` parallels, triangles at the poles, one chart with
/// its seam at longitude 0. Vertices are not doubled at the seam.
inline SurfaceMesh round_mesh(const RoundSurface& surface, int columns = 96, int rows = 64) {
    SurfaceMesh mesh;
    mesh.positions.push_back(surface(0, 0));
    for (int j = 1; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            mesh.positions.push_back(
                surface(2 * std::numbers::pi * i / columns, static_cast<double>(j) / rows));
    mesh.positions.push_back(surface(0, 1));
    const auto vertex = [&](int i, int j) {
        if (j == 0) return 0;
        return j == rows ? 1 + (rows - 1) * columns : 1 + (j - 1) * columns + i % columns;
    };
    const auto uv = [&](double i, int j) {
        return Vec2(0.02 + 0.96 * i / columns, 0.02 + 0.96 * static_cast<double>(j) / rows);
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            if (j == 0) {
                mesh.faces.push_back({0, vertex(i + 1, 1), vertex(i, 1), geometry::kNoVertex});
                mesh.corner_uvs.push_back({uv(i + 0.5, 0), uv(i + 1, 1), uv(i, 1), Vec2::Zero()});
            } else if (j == rows - 1) {
                mesh.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(0, rows), geometry::kNoVertex});
                mesh.corner_uvs.push_back({uv(i, j), uv(i + 1, j), uv(i + 0.5, rows), Vec2::Zero()});
            } else {
                mesh.faces.push_back(
                    {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
                mesh.corner_uvs.push_back({uv(i, j), uv(i + 1, j), uv(i + 1, j + 1), uv(i, j + 1)});
            }
        }
    return mesh;
}

inline Vec3 sphere_direction(double longitude, double along) {
    const double latitude = std::numbers::pi * (along - 0.5);
    return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
            std::sin(latitude)};
}

inline SurfaceMesh sphere_mesh(int columns = 96, int rows = 64, double radius_m = 0.04) {
    return round_mesh([=](double l, double a) -> Vec3 { return radius_m * sphere_direction(l, a); }, columns,
                      rows);
}

inline SurfaceMesh potato_mesh(int columns = 96, int rows = 64) {
    return round_mesh(
        [](double l, double a) -> Vec3 {
            const Vec3 d = sphere_direction(l, a);
            const double bumps = 0.07 * std::sin(2.1 * d.x() + 1.3 * d.y() - 0.7 * d.z() + 0.3) +
                                 0.06 * std::sin(3.1 * d.y() - 2.6 * d.x() + 2.2) +
                                 0.05 * std::sin(4.3 * d.z() + 2.8 * d.x() - 1.7 * d.y() + 4);
            return 0.04 * (1 + bumps) * Vec3(1.35 * d.x(), d.y(), 0.85 * d.z());
        },
        columns, rows);
}

/// Four lobes, with a deep dent around where the stalk was and a shallow one below: its outline turns back.
inline SurfaceMesh pepper_mesh(int columns = 96, int rows = 64) {
    return round_mesh(
        [](double l, double a) -> Vec3 {
            const double t = std::numbers::pi * a;  // 0 below, pi above
            const double rho = std::sin(t) * (1 - 0.15 * std::cos(t) * std::cos(t));
            const double lobes = 1 + 0.13 * std::cos(4 * l) * rho;
            const double dent_above = 0.75 * std::exp(-rho * rho / 0.16) * (a > 0.5 ? 1 : 0);
            const double dent_below = 0.3 * std::exp(-rho * rho / 0.12) * (a > 0.5 ? 0 : 1);
            const double z = -1.25 * std::cos(t) - dent_above + dent_below;
            return 0.04 * Vec3(rho * lobes * std::cos(l), rho * lobes * std::sin(l), z);
        },
        columns, rows);
}

inline SurfaceMesh pear_mesh(int columns = 96, int rows = 64) {
    return round_mesh(
        [](double l, double a) -> Vec3 {
            const double t = std::numbers::pi * a;
            const double z = -std::cos(t);
            const double neck = 1 - 0.48 / (1 + std::exp(-5 * (z - 0.15)));
            return 0.04 * Vec3(std::sin(t) * neck * std::cos(l) + 0.06 * z * z,
                               std::sin(t) * neck * std::sin(l), 1.45 * z);
        },
        columns, rows);
}

/// A rod of circles along an arc in the plane y = 0 that bends by `bend` radians over all, with round ends.
inline SurfaceMesh bent_rod(double length_m, double radius_m, double bend, int columns, int rows) {
    return round_mesh(
        [=](double l, double a) -> Vec3 {
            const double t = std::numbers::pi * a;
            // Angles eased towards the poles give round ends and even faces along the rod.
            const double s = -std::cos(t);  // -1 .. 1 along the axis
            const double profile = std::pow(1 - std::pow(std::abs(s), 4), 0.5);
            const double arc_radius = length_m / bend;
            const double angle = s * bend / 2;
            const Vec3 axis = arc_radius * Vec3(1 - std::cos(angle), 0, std::sin(angle));
            const Vec3 towards_centre(std::cos(angle), 0, -std::sin(angle));
            // A longitude turns from x to y when z is up: the rod's axis is z in its middle.
            return axis + radius_m * profile * (std::cos(l) * towards_centre + std::sin(l) * Vec3::UnitY());
        },
        columns, rows);
}

inline SurfaceMesh bean_mesh(int columns = 64, int rows = 96) {
    return bent_rod(0.020, 0.005, 1.7, columns, rows);
}

/// Five times as long as thick and bent by 80 degrees.
inline SurfaceMesh banana_mesh(int columns = 64, int rows = 128) {
    return bent_rod(0.17, 0.017, 1.4, columns, rows);
}

struct NamedSurface {
    std::string name;
    SurfaceMesh mesh;
};
inline std::vector<NamedSurface> fruit_meshes() {
    return {{"potato", potato_mesh()},
            {"pepper", pepper_mesh()},
            {"bean", bean_mesh()},
            {"pear", pear_mesh()},
            {"banana", banana_mesh()}};
}

/// The same surface with a vertex of its own for every face corner, as flat-shaded files have.
inline SurfaceMesh split_vertices(const SurfaceMesh& mesh) {
    SurfaceMesh split;
    split.corner_uvs = mesh.corner_uvs;
    for (const Face& face : mesh.faces) {
        Face own = face;
        for (int c = 0; c < geometry::corner_count(face); ++c) {
            own[c] = static_cast<std::int32_t>(split.positions.size());
            split.positions.push_back(mesh.positions[face[c]]);
        }
        split.faces.push_back(own);
    }
    return split;
}

}  // namespace windfall::test
