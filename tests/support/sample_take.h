#pragma once
// A small take for tests: a box of quadrilaterals and one triangle pair that shrinks and leans, with
// attributes.
#include "take/frame_sink.h"
#include "take/take_info.h"

namespace windfall {

inline take::TakeInfo sample_info() {
    take::TakeInfo info;
    info.process = "drying";
    info.name = "box";
    info.title = "A box, for tests";
    info.program_version = "0.1.0";
    info.seed = 7;
    info.unit_length_m = 0.02;
    info.parameters = {{"material.gamma", 10.0}, {"drying.shrinkage", 0.3}, {"mesh.n", 4}};
    info.look = {{"look.gloss", 0.5}};
    info.recipe_text = "[material]\ngamma = 10.0\n";
    return info;
}

/// A unit cube around the origin whose top is two triangles; texture coordinates with seams: each face is a
/// chart.
inline take::TakeMesh sample_mesh() {
    take::TakeMesh mesh;
    mesh.name = "skin";
    for (int i = 0; i < 8; ++i)
        mesh.rest.positions.emplace_back((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
    mesh.rest.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    mesh.rest.faces.push_back({2, 6, 7, geometry::kNoVertex});
    mesh.rest.faces.push_back({2, 7, 3, geometry::kNoVertex});
    for (std::size_t f = 0; f < mesh.rest.faces.size(); ++f) {
        const double u = 0.125 * static_cast<double>(f);
        mesh.rest.corner_uvs.push_back({geometry::Vec2(u, 0), geometry::Vec2(u + 0.125, 0),
                                        geometry::Vec2(u + 0.125, 0.5), geometry::Vec2(u, 0.5)});
    }
    take::Attribute direction{"direction", 3, {}};
    for (const auto& p : mesh.rest.positions)
        for (int k = 0; k < 3; ++k) direction.values.push_back(static_cast<float>(p.normalized()[k]));
    mesh.attributes.push_back(std::move(direction));
    return mesh;
}

inline take::Frame sample_frame(int index) {
    take::Frame frame;
    frame.index = index;
    frame.time = 0.1 * index;
    frame.scalars = {{"shrinkage", 0.05 * index}, {"flesh_volume_ratio", 1.0 / (1 + index)}};
    take::FrameMesh mesh;
    mesh.name = "skin";
    take::Attribute depth{"depth", 1, {}};
    const float shrink = 1.0f - 0.05f * static_cast<float>(index);
    for (const auto& p : sample_mesh().rest.positions) {
        Eigen::Vector3f moved = shrink * p.cast<float>();
        moved.x() += 0.02f * static_cast<float>(index) * moved.y();
        mesh.positions.push_back(moved);
        depth.values.push_back(0.01f * static_cast<float>(index) + static_cast<float>(mesh.positions.size()));
    }
    mesh.attributes.push_back(std::move(depth));
    frame.meshes.push_back(std::move(mesh));
    return frame;
}

inline void emit_sample(take::FrameSink& sink, int frames) {
    sink.add_mesh(sample_mesh());
    for (int i = 0; i < frames; ++i) sink.add_frame(sample_frame(i));
}

}  // namespace windfall
