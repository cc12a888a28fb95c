#pragma once
#include <fmt/format.h>

#include <string>

#include "geometry/surface_mesh.h"

namespace windfall::fracture {

/// A point as --at takes it.
inline std::string text_of(const geometry::Vec3& point) {
    return fmt::format("{:.5g},{:.5g},{:.5g}", point.x(), point.y(), point.z());
}

}  // namespace windfall::fracture
