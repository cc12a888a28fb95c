#include "picture/rotten_surface.h"

#include <fmt/format.h>

#include "core/error.h"
#include "picture/refinement.h"
#include "picture/texture_lookup.h"

namespace windfall::picture {

std::shared_ptr<const SurfaceTexture> texture_of(const take::Frame& frame, const std::string& mesh) {
    const take::FrameMap* base = frame.find_map(mesh, "base_color");
    if (base == nullptr || base->values.empty() || base->components < 3) return nullptr;
    auto texture = std::make_shared<SurfaceTexture>();
    texture->base_color = *base;
    const auto take_map = [&](const char* name, int components, take::FrameMap& target) {
        const take::FrameMap* map = frame.find_map(mesh, name);
        if (map != nullptr && map->components >= components) target = *map;
    };
    take_map("subsurface_color", 3, texture->subsurface_color);
    take_map("roughness", 1, texture->roughness);
    take_map("normal", 3, texture->normal);
    take_map("mold_mask", 1, texture->mold_mask);
    return texture;
}

std::vector<SceneHair> hair_of(const take::Frame& frame, const Eigen::Matrix3f& pose) {
    std::vector<SceneHair> hair;
    for (const auto& curves : frame.curves) {
        SceneHair strands;
        strands.points_per_strand = curves.points_per_strand;
        strands.radii = curves.radii;
        strands.colours = curves.colours;
        strands.points.reserve(curves.points.size());
        for (const auto& point : curves.points) strands.points.emplace_back(pose * point);
        hair.push_back(std::move(strands));
    }
    return hair;
}

bool is_furniture(const take::TakeMesh& mesh) { return mesh.name == "bowl" || mesh.name == "table"; }

bool is_hidden(const take::TakeMesh& mesh) { return mesh.name == "flesh" || mesh.name.starts_with("flesh_"); }

SceneMesh furniture_mesh(const take::TakeMesh& mesh, const take::FrameMesh& moved,
                         const Eigen::Matrix3f& pose) {
    if (moved.positions.size() != mesh.rest.positions.size())
        throw InputError(fmt::format("mesh \"{}\" has {} vertices in the frame and {} in the take", mesh.name,
                                     moved.positions.size(), mesh.rest.positions.size()));
    SceneMesh result;
    for (const auto& p : moved.positions) result.positions.emplace_back(pose * p);
    for (const auto& face : mesh.rest.faces) {
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t k = 0; k < 4; ++k)
            quad[k] = static_cast<std::uint32_t>(face[k] == geometry::kNoVertex ? face[2] : face[k]);
        result.quads.push_back(quad);
    }
    result.normals = smooth_normals(result.positions, result.quads);
    result.albedo.assign(result.positions.size(), Vec3f(0.62F, 0.60F, 0.56F));
    result.finishes[0].roughness = 0.25F;
    return result;
}

}  // namespace windfall::picture
