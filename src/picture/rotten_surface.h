#pragma once
// Fruit that the maps and the hair of its frames colour, instead of its look alone.
#include <memory>
#include <string>

#include "picture/scene.h"
#include "take/frame.h"

namespace windfall::picture {

struct SurfaceTexture;

/// The shading maps of a mesh in a frame; null when it has no base_color.
std::shared_ptr<const SurfaceTexture> texture_of(const take::Frame& frame, const std::string& mesh);

/// All hair of a frame, posed as its meshes are.
std::vector<SceneHair> hair_of(const take::Frame& frame, const Eigen::Matrix3f& pose);

/// Whether a mesh among those of fruit is what they lie in or on: "bowl" or "table".
bool is_furniture(const take::TakeMesh& mesh);

/// Whether a mesh lies inside of another one, out of sight: "flesh", "flesh_0" ...
bool is_hidden(const take::TakeMesh& mesh);

/// Glazed earthenware.
SceneMesh furniture_mesh(const take::TakeMesh& mesh, const take::FrameMesh& moved,
                         const Eigen::Matrix3f& pose);

}  // namespace windfall::picture
