#include "decay/skin_form.h"

#include <cmath>

#include "geometry/uv_raster.h"

namespace windfall::decay {

SkinForm::SkinForm(const geometry::CubeAtlas& atlas, const Specimen& specimen, double relative_size,
                   const Body& body)
    : m_texels(atlas.side()) {
    const int cells =
        static_cast<int>(std::lround(std::sqrt((static_cast<double>(body.skin().size()) - 2) / 6)));
    const geometry::BrickSurface brick = geometry::make_brick_surface({cells, cells, cells});
    if (specimen.artist == nullptr || !specimen.artist->own_uvs) {
        m_faces = body.faces();
        m_corner_uvs = atlas.corner_uvs(brick);
        return;
    }
    const ArtistFruit& artist = *specimen.artist;
    m_faces = artist.mesh.faces;
    m_corner_uvs = artist.mesh.corner_uvs;
    m_bake = std::make_unique<geometry::AtlasBake>(
        geometry::UvRaster(artist.mesh, artist.map.surface(), m_texels), artist.map, atlas);
    // Bound where both surfaces are fresh and stand as the file has them.
    std::vector<geometry::Vec3> vertices = artist.mesh.positions;
    for (geometry::Vec3& p : vertices) p *= relative_size;
    std::vector<Eigen::Vector3f> skin;
    skin.reserve(body.directions().size());
    for (const geometry::Vec3& d : body.directions())
        skin.emplace_back((relative_size * specimen.surface(d)).cast<float>());
    m_transfer = std::make_unique<geometry::SurfaceTransfer>(
        vertices, geometry::vertex_normals(vertices, m_faces), skin, brick.quads);
}

std::vector<Eigen::Vector3f> SkinForm::positions(const std::vector<Eigen::Vector3f>& body_points) const {
    return m_transfer ? m_transfer->moved(body_points) : body_points;
}

}  // namespace windfall::decay
