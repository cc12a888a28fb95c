#pragma once
// A rotten fruit without a simulation: a ball of 35 mm radius with one colony, painted by distance.
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/brick_surface.h"
#include "geometry/cube_atlas.h"
#include "take/frame.h"

namespace windfall {

inline constexpr double kBallRadius_m = 0.035;

inline take::TakeMesh rotten_ball(int side = 128, int cells = 12, const std::string& name = "skin") {
    take::TakeMesh mesh;
    mesh.name = name;
    const auto brick = geometry::make_brick_surface({cells, cells, cells});
    for (const auto& lattice : brick.lattice) {
        geometry::Vec3 p;
        for (int k = 0; k < 3; ++k)
            p[k] = std::tan((2.0 * lattice[static_cast<std::size_t>(k)] / cells - 1) * std::numbers::pi / 4);
        mesh.rest.positions.emplace_back(kBallRadius_m * p.normalized());
    }
    for (const auto& quad : brick.quads) mesh.rest.faces.push_back(quad);
    mesh.rest.corner_uvs = geometry::CubeAtlas(side).corner_uvs(brick);
    return mesh;
}

/// Where the colony began.
inline geometry::Vec3 colony_centre() { return geometry::Vec3(0.3, 0.4, 1).normalized(); }

inline double distance_to_colony_m(const geometry::Vec3& direction) {
    return kBallRadius_m * std::acos(std::clamp(direction.normalized().dot(colony_centre()), -1.0, 1.0));
}

/// Raw maps of a colony: rot out to `rot_m`, mold out to `mold_m`, active in the outer 4 mm.
inline take::Frame rotten_frame(int index, double rot_m, double mold_m, const std::string& fungus = "fungus",
                                int side = 128, const take::TakeMesh& mesh = rotten_ball()) {
    const geometry::CubeAtlas atlas(side);
    take::Frame frame;
    frame.index = index;
    frame.time = index;
    const std::string active = "fungus_active" + fungus.substr(std::string("fungus").size());
    for (const std::string& name : {std::string("nutrient"), fungus, active, std::string("soft_rot")}) {
        take::FrameMap map;
        map.name = name;
        map.mesh = mesh.name;
        map.width = map.height = side;
        std::vector<float> values(atlas.texel_count());
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!atlas.covered(i)) continue;
            const double r = distance_to_colony_m(atlas.texel_direction(i));
            const double rot = 0.3 * std::clamp((rot_m - r) / 4e-3, 0.0, 1.0);
            const double mold = std::clamp((mold_m - r) / 3e-3, 0.0, 1.0);
            const double share = std::clamp(1 - (mold_m - 4e-3 - r) / 3e-3, 0.0, 1.0);
            values[i] = static_cast<float>(name == "nutrient"   ? 1 - rot - 0.5 * mold
                                           : name == fungus     ? mold
                                           : name == "soft_rot" ? rot
                                                                : share);
        }
        atlas.bleed(values);
        for (const float value : values)
            map.values.push_back(static_cast<std::uint16_t>(65535 * std::clamp(value, 0.0F, 1.0F)));
        frame.maps.push_back(std::move(map));
    }
    take::FrameMesh moved{mesh.name, {}, {}};
    for (const auto& p : mesh.rest.positions) moved.positions.emplace_back(p.cast<float>());
    frame.meshes.push_back(std::move(moved));
    return frame;
}

}  // namespace windfall
