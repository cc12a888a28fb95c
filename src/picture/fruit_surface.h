#pragma once
// The skin of a fruit as a surface of the scene.
#include <functional>
#include <memory>
#include <string>

#include "picture/colouring.h"
#include "picture/look.h"
#include "picture/refinement.h"
#include "picture/scene.h"
#include "take/frame.h"

namespace windfall::picture {

/// One mesh of a take whose surface is smooth: refined once, coloured frame by frame.
class FruitSurface {
  public:
    /// `radius`: of the sphere about the fresh fruit, in which the look counts lengths; `picture_radius`: of
    /// the sphere whose picture is `picture_size` pixels wide. Throws InputError when a face names a vertex
    /// that is not there.
    FruitSurface(const take::TakeMesh& mesh, double radius, double picture_radius, int picture_size);

    const std::string& name() const { return m_mesh.name; }

    /// `dryness` 0 .. 1 goes from the fresh to the dry colour, where the vertices have no attribute "dryness"
    /// of their own. Throws InputError when the frame's vertices are not those of the mesh, are no numbers,
    /// or have not what the colouring shows.
    SceneMesh scene_mesh(const take::FrameMesh& moved, const Look& look, const Eigen::Matrix3f& pose,
                         double dryness) const;
    /// With the shading maps of a frame in place of the look's colours (decay); `texture` must have a
    /// base_color, and the mesh texture coordinates.
    SceneMesh textured_mesh(const take::FrameMesh& moved, const Look& look, const Eigen::Matrix3f& pose,
                            std::shared_ptr<const SurfaceTexture> texture) const;
    SceneMesh diagram_mesh(const take::FrameMesh& moved, Colouring colouring, const ColourRange& range,
                           const Eigen::Matrix3f& pose) const;

  private:
    /// Positions, fresh positions and two values of each vertex, refined.
    Channels refined(const take::FrameMesh& moved, const Eigen::Matrix3f& pose,
                     const std::function<Eigen::Vector2f(std::size_t)>& values) const;

    take::TakeMesh m_mesh;
    double m_radius;
    int m_levels;
    Refinement m_refinement;
};

}  // namespace windfall::picture
