#pragma once
// What rots: a shape of our own or an artist's mesh.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "decay/body.h"
#include "decay/parameters.h"
#include "geometry/sphere_map.h"
#include "geometry/sphere_map_interior.h"

namespace windfall::decay {

/// An artist's mesh as a fruit (m, z up).
struct ArtistFruit {
    geometry::SurfaceMesh mesh;  ///< vertices in the file's order
    geometry::SphereMap map;     ///< of that mesh
    geometry::SphereInterior interior;
    bool own_uvs = true;  ///< whether maps go into the mesh's own texture coordinates

    /// Throws InputError as SphereMap and SphereInterior do.
    /// `flesh_cells` as in BodySettings.
    ArtistFruit(geometry::SurfaceMesh its_mesh, bool in_own_uvs, int flesh_cells)
        : mesh(std::move(its_mesh)), map(mesh), interior(map, flesh_cells), own_uvs(in_own_uvs) {}
};

/// Shape of the fruit about its middle (m, z up along the axis), and what came from files with it.
struct Specimen {
    SurfaceFunction surface;
    InteriorFunction interior;                  ///< empty: straight lines from the centre
    std::vector<float> mask;                    ///< start.mask on the texels of the atlas; empty: none
    std::shared_ptr<const ArtistFruit> artist;  ///< null: a shape of our own
};

/// Throws std::logic_error for kind Mesh.
Specimen specimen_of(const FruitParameters& fruit);
/// The same of an artist's mesh.
Specimen specimen_of(const std::shared_ptr<const ArtistFruit>& artist);

/// Throws InputError for a wound (start.wounds_m) that is off a single fruit. Of a pile it is known only when
/// it has settled.
void check_wounds(const DecayParameters& parameters, const SurfaceFunction& surface);

/// A wound that is farther from the fruit than this (m) is a mistake.
inline constexpr double kOnTheFruit_m = 0.01;

/// What is said of such a wound, whose nearest place on the skin is `nearest`; both in the axes of takes.
std::string off_the_fruit_text(const geometry::Vec3& wound, const geometry::Vec3& nearest);

/// Between the axes of fruit (z up) and those of a take (y up).
inline Eigen::Vector3f take_axes(const Eigen::Vector3f& p) { return {p.x(), p.z(), -p.y()}; }
inline geometry::Vec3 fruit_axes(const geometry::Vec3& p) { return {p.x(), -p.z(), p.y()}; }

}  // namespace windfall::decay
