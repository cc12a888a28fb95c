#pragma once
// A wrinkled fruit without a simulation, to test pictures with: a cubed sphere with labyrinth-like grooves.
#include <cmath>
#include <map>
#include <string>

#include "picture/mottle.h"
#include "take/frame.h"

namespace windfall::test {

/// Sphere of six patches of n x n quadrilaterals, stretched along y.
inline take::TakeMesh cubed_sphere(int n, double stretch_y = 1) {
    take::TakeMesh mesh;
    mesh.name = "skin";
    std::map<std::array<int, 3>, std::int32_t> known;
    const auto vertex = [&](std::array<int, 3> lattice) {
        const auto [at, fresh] = known.try_emplace(lattice, static_cast<std::int32_t>(known.size()));
        if (fresh) {
            geometry::Vec3 p;
            for (int k = 0; k < 3; ++k)
                p[k] = std::tan((2.0 * lattice[static_cast<std::size_t>(k)] / n - 1) * 0.785398163397448);
            p.normalize();
            mesh.rest.positions.emplace_back(p.x(), stretch_y * p.y(), p.z());
        }
        return at->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, n})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto corner = [&](int di, int dj) {
                        std::array<int, 3> lattice{};
                        lattice[axis] = side;
                        lattice[(axis + 1) % 3] = i + di;
                        lattice[(axis + 2) % 3] = j + dj;
                        return vertex(lattice);
                    };
                    geometry::Face face{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                    if (side == 0) std::swap(face[1], face[3]);
                    mesh.rest.faces.push_back(face);
                }
    return mesh;
}

/// The fruit shrunk and wrinkled; carries "depth" and the scalar "shrinkage".
inline take::Frame wrinkled(const take::TakeMesh& mesh, int index, double shrinkage) {
    take::Frame frame;
    frame.index = index;
    frame.time = shrinkage;
    frame.scalars["shrinkage"] = shrinkage;
    take::FrameMesh moved{mesh.name, {}, {{"depth", 1, {}}}};
    const float amplitude = 0.32F * static_cast<float>(std::max(0.0, shrinkage - 0.05));
    for (const auto& p : mesh.rest.positions) {
        const Eigen::Vector3f place = p.cast<float>(), direction = place.normalized();
        const float noise =
            picture::smooth_noise(3.6F * place, 99) + 0.35F * picture::smooth_noise(6.1F * place, 98);
        const float groove = std::exp(-14 * noise * noise);
        const float depth = amplitude * (1.9F * groove - 0.7F);
        moved.positions.emplace_back((1 - static_cast<float>(shrinkage)) * place - depth * direction);
        moved.attributes[0].values.push_back(depth);
    }
    frame.meshes.push_back(moved);
    return frame;
}

}  // namespace windfall::test
