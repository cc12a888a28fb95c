#pragma once
// A picture that an artist painted over a fruit's texture coordinates.
#include <filesystem>
#include <string>

#include "geometry/surface_mesh.h"
#include "picture/image.h"

namespace windfall::recipe {

/// Brightness 0..1 of a square picture over texture coordinates (v up).
class PaintedMask {
  public:
    /// Throws InputError, beginning with the `key` that names the file, where it cannot be read or is not
    /// square.
    PaintedMask(const std::string& key, const std::filesystem::path& file);

    float at(const geometry::Vec2& uv) const;

  private:
    picture::Image8 m_image;
};

}  // namespace windfall::recipe
