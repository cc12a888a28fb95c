#include "picture/fruit_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "picture/skin_colour.h"

namespace windfall::picture {
namespace {

/// More quadrilaterals than this no picture needs, and memory would begin to count.
constexpr std::size_t kMostQuads = 2'000'000;
/// Facets of this many pixels are not seen.
constexpr double kFacetPixels = 3.6;

int levels_for(const take::TakeMesh& mesh, double radius, int picture_size) {
    double sum = 0;
    std::size_t count = 0;
    for (const auto& face : mesh.rest.faces) {
        const auto a = static_cast<std::size_t>(face[0]), b = static_cast<std::size_t>(face[1]);
        sum += (mesh.rest.positions[b] - mesh.rest.positions[a]).norm();
        ++count;
    }
    const double pixels = sum / static_cast<double>(count) * picture_size / (2 * kFramingMargin * radius);
    int levels = std::clamp(static_cast<int>(std::ceil(std::log2(pixels / kFacetPixels))), 1, 4);
    while (levels > 1 && (mesh.rest.faces.size() << 2 * static_cast<unsigned>(levels)) > kMostQuads) --levels;
    return levels;
}

SceneMesh bare_mesh(const Channels& fine, const Refinement& refinement) {
    SceneMesh result;
    result.quads = refinement.quads();
    for (Eigen::Index row = 0; row < fine.rows(); ++row)
        result.positions.emplace_back(fine.block<1, 3>(row, 0).transpose());
    result.normals = smooth_normals(result.positions, result.quads);
    return result;
}

void add_finish(SceneMesh& mesh, const Look& look, float radius, const Channels& fine) {
    Finish& finish = mesh.finishes[0];
    finish.roughness = static_cast<float>(look.roughness);
    finish.gloss = static_cast<float>(look.gloss);
    for (int c = 0; c < 3; ++c)
        finish.scatter[c] =
            static_cast<float>(look.softness * look.softness_colour[static_cast<std::size_t>(c)]) * radius;
    if (look.pores <= 0) return;
    finish.grain = Grain::Peel;
    finish.pore_size = static_cast<float>(look.pore_size) * radius;
    finish.pore_depth = static_cast<float>(look.pores);
    for (Eigen::Index row = 0; row < fine.rows(); ++row)
        mesh.rest.emplace_back(fine.block<1, 3>(row, 3).transpose());
}

}  // namespace

FruitSurface::FruitSurface(const take::TakeMesh& mesh, double radius, double picture_radius, int picture_size)
    : m_mesh(mesh),
      m_radius(radius),
      m_levels(levels_for(mesh, picture_radius, picture_size)),
      m_refinement(mesh.rest.faces, mesh.rest.positions.size(), m_levels) {}

Channels FruitSurface::refined(const take::FrameMesh& moved, const Eigen::Matrix3f& pose,
                               const std::function<Eigen::Vector2f(std::size_t)>& values) const {
    const std::size_t count = m_mesh.rest.positions.size();
    if (moved.positions.size() != count)
        throw InputError(fmt::format("mesh \"{}\" has {} vertices in the frame and {} in the take",
                                     m_mesh.name, moved.positions.size(), count));
    Channels coarse(static_cast<Eigen::Index>(count), 8);
    for (std::size_t v = 0; v < count; ++v) {
        const auto row = static_cast<Eigen::Index>(v);
        coarse.block<1, 3>(row, 0) = (pose * moved.positions[v]).transpose();
        coarse.block<1, 3>(row, 3) = m_mesh.rest.positions[v].cast<float>().transpose();
        coarse.block<1, 2>(row, 6) = values(v).transpose();
    }
    if (!coarse.allFinite())
        throw InputError(fmt::format("mesh \"{}\" has positions that are no numbers", m_mesh.name));
    return m_refinement.apply(coarse);
}

SceneMesh FruitSurface::scene_mesh(const take::FrameMesh& moved, const Look& look,
                                   const Eigen::Matrix3f& pose, double dryness) const {
    const auto attribute_or = [&](const char* name, double otherwise) {
        const take::Attribute* found = moved.find(name);
        const bool fits = found != nullptr && found->values.size() == moved.positions.size();
        return fits ? found->values
                    : std::vector<float>(moved.positions.size(), static_cast<float>(otherwise));
    };
    const std::vector<float> depths = attribute_or("depth", 0);
    const std::vector<float> drynesses = attribute_or("dryness", dryness);
    const Channels fine =
        refined(moved, pose, [&](std::size_t v) { return Eigen::Vector2f(depths[v], drynesses[v]); });
    SceneMesh result = bare_mesh(fine, m_refinement);
    const auto radius = static_cast<float>(m_radius);
    std::vector<SkinPoint> skin(static_cast<std::size_t>(fine.rows()));
    for (Eigen::Index row = 0; row < fine.rows(); ++row)
        skin[static_cast<std::size_t>(row)] = {fine.block<1, 3>(row, 3).transpose() / radius,
                                               fine(row, 6) / radius, fine(row, 7)};
    result.albedo = skin_colours(look, skin);
    roughen_normals(look, skin, result.normals);
    add_finish(result, look, radius, fine);
    return result;
}

SceneMesh FruitSurface::textured_mesh(const take::FrameMesh& moved, const Look& look,
                                      const Eigen::Matrix3f& pose,
                                      std::shared_ptr<const SurfaceTexture> texture) const {
    const Channels fine = refined(moved, pose, [](std::size_t) { return Eigen::Vector2f(0, 0); });
    SceneMesh result = bare_mesh(fine, m_refinement);
    result.texture = std::move(texture);
    result.quad_uvs = refined_corners(m_mesh.rest.faces, m_mesh.rest.corner_uvs, m_levels);
    add_finish(result, look, static_cast<float>(m_radius), fine);
    return result;
}

SceneMesh FruitSurface::diagram_mesh(const take::FrameMesh& moved, Colouring colouring,
                                     const ColourRange& range, const Eigen::Matrix3f& pose) const {
    const std::vector<double> shown = shown_values(colouring, m_mesh, moved);
    const Channels fine =
        refined(moved, pose, [&](std::size_t v) { return Eigen::Vector2f(static_cast<float>(shown[v]), 0); });
    SceneMesh result = bare_mesh(fine, m_refinement);
    for (Eigen::Index row = 0; row < fine.rows(); ++row) {
        const auto colour = shown_colour(colouring, static_cast<double>(fine(row, 6)), range);
        result.albedo.emplace_back(colour[0], colour[1], colour[2]);
    }
    result.finishes[0].gloss = 0;
    return result;
}

}  // namespace windfall::picture
