#include "recipe/specimen_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "geometry/cube_atlas.h"
#include "geometry/surface_check.h"
#include "geometry/uv_raster.h"
#include "meshfile/mesh_file.h"
#include "recipe/mesh_surface.h"
#include "recipe/painted_mask.h"

namespace windfall::recipe {
namespace {

/// Where a direction lies in the texture of the specimen.
geometry::Vec2 texture_place(const decay::Specimen& specimen, const geometry::CubeAtlas& atlas,
                             const geometry::Vec3& direction) {
    if (specimen.artist == nullptr || !specimen.artist->own_uvs) {
        const auto point = geometry::CubeAtlas::chart_point(direction);
        return atlas.uv(point.chart, point.s, point.t);
    }
    const geometry::SphereMap& map = specimen.artist->map;
    return geometry::uv_at(specimen.artist->mesh, map.surface(), map.place(direction));
}

std::vector<float> mask_of(const decay::Specimen& specimen, const decay::DecayParameters& parameters) {
    const PaintedMask picture("start.mask", parameters.start.mask);
    const geometry::CubeAtlas atlas(static_cast<int>(parameters.output.texels));
    std::vector<float> mask(atlas.texel_count(), 0);
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (atlas.covered(i)) mask[i] = picture.at(texture_place(specimen, atlas, atlas.texel_direction(i)));
    return mask;
}

decay::Specimen artist_specimen(const decay::DecayParameters& parameters) {
    const decay::FruitParameters& fruit = parameters.fruit;
    const std::string name = "fruit.mesh " + fruit.mesh;
    geometry::SurfaceMesh mesh = surface_of(meshfile::read(fruit.mesh));
    geometry::require_closed(mesh, name);
    if (fruit.uvs == decay::MeshUvs::Own) require_own_uvs(mesh, name);
    if (fruit.up == decay::UpAxis::Y)
        for (geometry::Vec3& p : mesh.positions) p = decay::fruit_axes(p);
    geometry::Vec3 low = mesh.positions.front(), high = low;
    for (const geometry::Vec3& p : mesh.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double volume = geometry::enclosed_volume(mesh.positions, mesh.faces);
    const double scale = std::cbrt(fruit.mass_kg / decay::kFruitDensity_kg_m3 / volume);
    for (geometry::Vec3& p : mesh.positions) p = scale * (p - 0.5 * (low + high));
    return decay::specimen_of(std::make_shared<const decay::ArtistFruit>(
        std::move(mesh), fruit.uvs == decay::MeshUvs::Own, static_cast<int>(parameters.body.flesh_cells)));
}

}  // namespace

decay::Specimen read_specimen(const decay::DecayParameters& parameters) {
    decay::Specimen specimen = parameters.fruit.kind == decay::FruitKind::Mesh
                                   ? artist_specimen(parameters)
                                   : decay::specimen_of(parameters.fruit);
    if (!parameters.start.mask.empty()) specimen.mask = mask_of(specimen, parameters);
    return specimen;
}

}  // namespace windfall::recipe
