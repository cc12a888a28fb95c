#include "recipe/fruit_file.h"

#include <string>

#include "geometry/surface_check.h"
#include "meshfile/mesh_file.h"
#include "recipe/mesh_surface.h"

namespace windfall::recipe {
namespace {

geometry::SurfaceMesh read_closed(const std::string& key, const std::string& file) {
    geometry::SurfaceMesh mesh = surface_of(meshfile::read(file));
    geometry::require_closed(mesh, key + " " + file);
    return mesh;
}

}  // namespace

std::optional<drying::ArtistMeshes> read_meshes(const drying::DryingParameters& parameters) {
    const drying::FruitParameters& fruit = parameters.fruit;
    if (fruit.mesh.empty()) return std::nullopt;
    drying::ArtistMeshes meshes{read_closed("fruit.mesh", fruit.mesh), std::nullopt};
    if (fruit.stone == drying::StoneKind::Mesh)
        meshes.stone = read_closed("fruit.stone_mesh", fruit.stone_mesh);
    drying::check_thickness(meshes.fruit, fruit);
    const drying::MoistureParameters& moisture = parameters.moisture;
    if (moisture.on() && !moisture.map.empty() && fruit.uvs == drying::TakeSkin::Own)
        require_own_uvs(meshes.fruit, "fruit.mesh " + fruit.mesh);
    return meshes;
}

std::unique_ptr<const drying::ArtistFruit> read_fruit(const drying::DryingParameters& parameters) {
    const auto meshes = read_meshes(parameters);
    return meshes ? std::make_unique<const drying::ArtistFruit>(*meshes, parameters) : nullptr;
}

double real_r1_m(const drying::DryingParameters& parameters) {
    const drying::FruitParameters& fruit = parameters.fruit;
    if (fruit.mesh.empty()) return fruit.size_m;
    return fruit.unit_m * drying::equivalent_radius(surface_of(meshfile::read(fruit.mesh)));
}

}  // namespace windfall::recipe
