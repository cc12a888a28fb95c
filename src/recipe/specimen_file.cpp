#include "recipe/specimen_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "geometry/cube_atlas.h"
#include "geometry/surface_check.h"
#include "geometry/uv_check.h"
#include "geometry/uv_raster.h"
#include "meshfile/mesh_file.h"
#include "picture/image.h"
#include "recipe/mesh_surface.h"
#include "take/whole_file.h"

namespace windfall::recipe {
namespace {

constexpr std::uint64_t kLargestMask = std::uint64_t{1} << 28U;

/// Brightness 0..1 of a square picture over texture coordinates (v up).
class Mask {
  public:
    explicit Mask(const std::filesystem::path& file) {
        try {
            m_image = picture::decode_png(take::read_whole_file(file, kLargestMask));
        } catch (const std::exception& error) {
            throw InputError(fmt::format("start.mask {}: {}", file.string(), error.what()));
        }
        if (m_image.width != m_image.height || m_image.width < 1)
            throw InputError(fmt::format("start.mask {} has {} x {} pixels; it must be square", file.string(),
                                         m_image.width, m_image.height));
    }

    float at(const geometry::Vec2& uv) const {
        const auto pixel = [size = m_image.width](double x) {
            return static_cast<std::size_t>(std::clamp(static_cast<int>(x * size), 0, size - 1));
        };
        const std::size_t first =
            3 * (pixel(1 - uv.y()) * static_cast<std::size_t>(m_image.width) + pixel(uv.x()));
        // Rec. 709
        return (0.2126F * m_image.bytes[first] + 0.7152F * m_image.bytes[first + 1] +
                0.0722F * m_image.bytes[first + 2]) /
               255;
    }

  private:
    picture::Image8 m_image;
};

/// Where a direction lies in the texture of the specimen.
geometry::Vec2 texture_place(const decay::Specimen& specimen, const geometry::CubeAtlas& atlas,
                             const geometry::Vec3& direction) {
    if (specimen.artist == nullptr || !specimen.artist->own_uvs) {
        const auto point = geometry::CubeAtlas::chart_point(direction);
        return atlas.uv(point.chart, point.s, point.t);
    }
    const geometry::SphereMap& map = specimen.artist->map;
    const geometry::SurfacePlace place = map.place(direction);
    const auto uvs = geometry::uvs_of(specimen.artist->mesh,
                                      map.surface().origin[static_cast<std::size_t>(place.triangle)]);
    return place.weights[0] * uvs[0] + place.weights[1] * uvs[1] + place.weights[2] * uvs[2];
}

std::vector<float> mask_of(const decay::Specimen& specimen, const decay::DecayParameters& parameters) {
    const Mask picture(parameters.start.mask);
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
    if (fruit.uvs == decay::MeshUvs::Own) {
        try {
            geometry::require_uvs(mesh, name);
        } catch (const InputError& error) {
            throw InputError(
                fmt::format("{}\nor set fruit.uvs = \"atlas\": the take then has a skin of its own in the "
                            "mesh's shape, with texture coordinates of its own",
                            error.what()));
        }
    }
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
