#pragma once
// A fruit whose shape is an artist's closed mesh instead of ten numbers.
#include <optional>
#include <string>
#include <vector>

#include "drying/parameters.h"
#include "geometry/curved_surface.h"
#include "geometry/layered_mesh.h"
#include "geometry/sphere_map.h"

namespace windfall::drying {

/// The meshes of a recipe, read and found closed; lengths in the units of the mesh's file.
struct ArtistMeshes {
    geometry::SurfaceMesh fruit;
    std::optional<geometry::SurfaceMesh> stone;  ///< for StoneKind::Mesh
};

/// r_1 of a closed mesh: radius of the ball of the same volume, in the units of its file.
double equivalent_radius(const geometry::SurfaceMesh& mesh);

/// Immutable once made. Its geometry stays in the units of the file, so that what is said of it names places
/// that can be found in it; the solver's lengths are over `r1`.
class ArtistFruit {
  public:
    /// Throws InputError with the place where the surface cannot be laid on the sphere, and for a stone that
    /// does not lie inside.
    ArtistFruit(const ArtistMeshes& meshes, const DryingParameters& parameters);

    const geometry::SurfaceMesh& mesh() const { return m_mesh; }
    double r1() const { return m_r1; }
    /// Length over width of the brick that is laid on it.
    double elongation() const { return m_elongation; }
    const geometry::SphereMap& map() const { return m_map; }
    const geometry::CurvedSurface& surface() const { return m_surface; }
    /// Null unless a stone is given.
    const geometry::CurvedSurface* stone() const { return m_stone ? &*m_stone : nullptr; }

    /// The mesh's vertices, in r_1.
    std::vector<geometry::Vec3> vertices() const;

    /// The mesh's texture coordinates at the middles of the quads of a skin laid on it. Throws InputError
    /// where it has none.
    std::vector<geometry::Vec2> uvs_under(const geometry::LayeredMesh& mesh) const;

  private:
    geometry::SurfaceMesh m_mesh;
    geometry::SphereMap m_map;
    geometry::CurvedSurface m_surface;
    std::optional<geometry::CurvedSurface> m_stone;
    double m_r1 = 1;
    double m_elongation = 1;
};

/// How thick a mesh is, from balls inside that touch it at its vertices (at most 4000 of them).
struct Thickness {
    double smallest = 0;  ///< radius of the smallest ball, in the units of the file
    geometry::Vec3 smallest_place = geometry::Vec3::Zero();
    double mean = 0;  ///< of the radii
};
Thickness thickness_of(const geometry::SurfaceMesh& mesh, double skin_thickness);

/// Throws InputError with the place where the mesh is thinner than two skins to either side; gives a warning
/// where it is thinner than three.
std::vector<std::string> check_thickness(const geometry::SurfaceMesh& mesh, const FruitParameters& fruit);

}  // namespace windfall::drying
