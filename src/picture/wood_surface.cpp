#include "picture/wood_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"

namespace windfall::picture {
namespace {

struct KnownMaterial {
    const char* name;
    Grain grain;
    float roughness, gloss;
    std::array<float, 3> colour;  ///< linear RGB, where the take has none
};

constexpr std::array<KnownMaterial, 6> kKnownMaterials{{
    {"bark", Grain::Bark, 0.9F, 0, {0.20F, 0.16F, 0.12F}},
    {"end_grain", Grain::EndGrain, 0.75F, 0, {0.60F, 0.45F, 0.28F}},
    {"fibres", Grain::Fibres, 0.7F, 0, {0.66F, 0.51F, 0.32F}},
    {"thorns", Grain::Fibres, 0.7F, 0, {0.70F, 0.56F, 0.37F}},
    {"inner_bark", Grain::Fibres, 0.8F, 0, {0.30F, 0.18F, 0.10F}},
    {"crack", Grain::Fibres, 0.8F, 0, {0.42F, 0.28F, 0.15F}},
}};
constexpr KnownMaterial kPlainMaterial{"", Grain::None, 0.7F, 0, {0.5F, 0.5F, 0.5F}};

const KnownMaterial& known_material(const std::string& name) {
    for (const auto& known : kKnownMaterials)
        if (name == known.name) return known;
    return kPlainMaterial;
}

/// Positions, faces and normals, and where materials lie.
SceneMesh bare_wood(const take::TakeMesh& mesh, const take::FrameMesh& moved) {
    if (moved.positions.size() != mesh.rest.positions.size())
        throw InputError(fmt::format("mesh \"{}\" has {} vertices in the frame and {} in the take", mesh.name,
                                     moved.positions.size(), mesh.rest.positions.size()));
    SceneMesh result;
    result.positions = moved.positions;
    for (const Vec3f& p : result.positions)
        if (!p.allFinite())
            throw InputError(fmt::format("mesh \"{}\" has positions that are no numbers", mesh.name));
    for (const auto& face : mesh.rest.faces) {
        const auto corner = [&](std::size_t k) { return static_cast<std::uint32_t>(face[k]); };
        const std::uint32_t last = geometry::corner_count(face) == 3 ? corner(2) : corner(3);
        result.quads.push_back({corner(0), corner(1), corner(2), last});
    }
    result.finishes.clear();
    for (const auto& material : mesh.materials) result.finishes.push_back(wood_finish(material));
    result.quad_finishes = mesh.face_materials;
    result.normals.assign(result.positions.size(), Vec3f::Zero());
    for (std::size_t f = 0; f < result.quads.size(); ++f) {
        if (result.finishes[result.quad_finishes[f]].hard) continue;
        const Vec3f area = facet_area(result.positions, result.quads[f]);
        for (const std::uint32_t v : result.quads[f]) result.normals[v] += area;
    }
    for (Vec3f& n : result.normals) n = n.squaredNorm() > 0 ? Vec3f(n.normalized()) : Vec3f::UnitY();
    return result;
}

std::vector<Vec3f> colours_of(const take::TakeMesh& mesh) {
    const std::size_t count = mesh.rest.positions.size();
    std::vector<Vec3f> colours(count);
    const take::Attribute* colour = mesh.find("colour");
    if (colour != nullptr && colour->components == 3 && colour->values.size() == 3 * count) {
        for (std::size_t v = 0; v < count; ++v)
            colours[v] = Vec3f(colour->values[3 * v], colour->values[3 * v + 1], colour->values[3 * v + 2])
                             .cwiseMax(0.0F)
                             .cwiseMin(1.0F);
        return colours;
    }
    for (std::size_t f = 0; f < mesh.rest.faces.size(); ++f) {
        const auto& own = known_material(mesh.materials[mesh.face_materials[f]].name).colour;
        for (int k = 0; k < geometry::corner_count(mesh.rest.faces[f]); ++k)
            colours[static_cast<std::size_t>(mesh.rest.faces[f][static_cast<std::size_t>(k)])] =
                Vec3f(own[0], own[1], own[2]);
    }
    return colours;
}

constexpr std::size_t kBinsUp = 64, kBinsAround = 32;

/// An upright box, grown point by point.
struct Bounds {
    Vec3f low = Vec3f::Constant(1e30F), high = Vec3f::Constant(-1e30F);
    void add(const Vec3f& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    bool empty() const { return low.x() > high.x(); }
    float width() const { return std::max(high.x() - low.x(), high.z() - low.z()); }
};

/// Calls use(mesh, positions) for every mesh at every moment.
template <class Use>
void for_each_moment(const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> frames,
                     const Use& use) {
    for (const auto& frame : frames)
        for (const auto& mesh : meshes)
            for (const auto& moved : frame.meshes)
                if (moved.name == mesh.name && moved.positions.size() == mesh.rest.positions.size())
                    use(mesh, moved.positions);
}

/// The torn and cracked faces; the rim of the inner bark is left out, since sawn ends have one too.
bool is_broken(const take::Material& material) { return material.hard && material.name != "inner_bark"; }

/// About the broken faces, with some of the branch below; empty when nothing is broken.
Bounds broken_part(const std::vector<take::TakeMesh>& meshes, std::span<const take::Frame> frames) {
    Bounds broken, result;
    float branch_width = 1e30F;
    for_each_moment(meshes, frames, [&](const take::TakeMesh& mesh, const std::vector<Vec3f>& positions) {
        Bounds own;
        for (std::size_t f = 0; f < mesh.rest.faces.size(); ++f)
            if (is_broken(mesh.materials[mesh.face_materials[f]]))
                for (int k = 0; k < geometry::corner_count(mesh.rest.faces[f]); ++k)
                    own.add(
                        positions[static_cast<std::size_t>(mesh.rest.faces[f][static_cast<std::size_t>(k)])]);
        if (own.empty()) return;
        broken.add(own.low);
        broken.add(own.high);
        branch_width = std::min(branch_width, own.width());
    });
    if (broken.empty()) return result;
    const float lowest = broken.low.y() - 0.3F * branch_width;
    for_each_moment(meshes, frames, [&](const take::TakeMesh& mesh, const std::vector<Vec3f>& positions) {
        (void)mesh;
        for (const Vec3f& p : positions)
            if (p.y() >= lowest && p.y() <= broken.high.y()) result.add(p);
    });
    return result;
}

}  // namespace

Finish wood_finish(const take::Material& material) {
    const KnownMaterial& known = known_material(material.name);
    Finish finish;
    finish.grain = known.grain;
    finish.roughness = known.roughness;
    finish.gloss = known.gloss;
    finish.hard = material.hard;
    return finish;
}

SceneMesh wood_mesh(const take::TakeMesh& mesh, const take::FrameMesh& moved) {
    SceneMesh result = bare_wood(mesh, moved);
    result.albedo = colours_of(mesh);
    for (const auto& p : mesh.rest.positions) result.rest.emplace_back(p.cast<float>());
    return result;
}

SceneMesh wood_diagram(const take::TakeMesh& mesh, const take::FrameMesh& moved, Colouring colouring,
                       const ColourRange& range) {
    SceneMesh result = bare_wood(mesh, moved);
    for (const double value : shown_values(colouring, mesh, moved)) {
        const auto colour = shown_colour(colouring, value, range);
        result.albedo.emplace_back(colour[0], colour[1], colour[2]);
    }
    for (Finish& finish : result.finishes) finish.grain = Grain::None;
    return result;
}

Region wood_region(View view, const std::vector<take::TakeMesh>& meshes,
                   std::span<const take::Frame> frames) {
    Bounds bounds;
    if (view == View::Break) bounds = broken_part(meshes, frames);
    if (bounds.empty())
        for_each_moment(meshes, frames, [&](const take::TakeMesh& mesh, const std::vector<Vec3f>& positions) {
            (void)mesh;
            for (const Vec3f& p : positions) bounds.add(p);
        });
    if (bounds.empty() || !bounds.low.allFinite() || !bounds.high.allFinite())
        throw InputError("the take has no surface to show");
    Region region;
    region.centre = (bounds.low + bounds.high) / 2;
    region.half_height = (bounds.high.y() - bounds.low.y()) / 2;
    if (!((bounds.high - bounds.low).maxCoeff() > 0)) throw InputError("the surface of the take has no size");
    // Of all points in a small part of the height and of the circle the farthest from the axis decides.
    std::vector<std::pair<float, Vec3f>> farthest(kBinsUp * kBinsAround, {-1.0F, Vec3f::Zero()});
    for_each_moment(meshes, frames, [&](const take::TakeMesh& mesh, const std::vector<Vec3f>& positions) {
        (void)mesh;
        for (const Vec3f& p : positions) {
            if (p.y() < bounds.low.y() || p.y() > bounds.high.y()) continue;
            const Vec3f d = p - region.centre;
            const float up = (p.y() - bounds.low.y()) / std::max(1e-9F, 2 * region.half_height);
            const float around = std::atan2(d.z(), d.x()) / (2 * std::numbers::pi_v<float>)+0.5F;
            const auto bin = [](float share, std::size_t count) {
                return std::min(count - 1, static_cast<std::size_t>(share * static_cast<float>(count)));
            };
            auto& best = farthest[bin(up, kBinsUp) * kBinsAround + bin(around, kBinsAround)];
            const float distance_sq = d.x() * d.x() + d.z() * d.z();
            if (distance_sq > best.first) best = {distance_sq, p};
        }
    });
    for (const auto& [distance_sq, point] : farthest)
        if (distance_sq >= 0) region.points.push_back(point);
    return region;
}

}  // namespace windfall::picture
