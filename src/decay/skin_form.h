#pragma once
// What a take shows of a fruit: Windfall's own skin and atlas, or the artist's vertices and texture.
#include <memory>
#include <vector>

#include "decay/body.h"
#include "decay/specimen.h"
#include "geometry/cube_atlas.h"
#include "geometry/surface_transfer.h"
#include "geometry/uv_raster_bake.h"

namespace windfall::decay {

class SkinForm {
  public:
    /// `relative_size`: of the fruit over the specimen. Throws InputError where the artist's vertices are too
    /// far from the body's skin.
    SkinForm(const geometry::CubeAtlas& atlas, const Specimen& specimen, double relative_size,
             const Body& body);

    const std::vector<geometry::Face>& faces() const { return m_faces; }
    const std::vector<std::array<geometry::Vec2, 4>>& corner_uvs() const { return m_corner_uvs; }
    /// The take's vertices for points of the body's skin (or flesh) vertices.
    std::vector<Eigen::Vector3f> positions(const std::vector<Eigen::Vector3f>& body_points) const;

    /// Takes maps over into the artist's texture; null where the atlas is the texture.
    const geometry::AtlasBake* bake() const { return m_bake.get(); }
    /// Side of the texture.
    int texels() const { return m_texels; }

  private:
    std::vector<geometry::Face> m_faces;
    std::vector<std::array<geometry::Vec2, 4>> m_corner_uvs;
    std::unique_ptr<geometry::SurfaceTransfer> m_transfer;
    std::unique_ptr<geometry::AtlasBake> m_bake;
    int m_texels;
};

}  // namespace windfall::decay
