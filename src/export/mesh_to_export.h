#pragma once
// What every format writes: one mesh at one moment, in metres, Y up.
#include <cstddef>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"
#include "take/frame.h"

namespace windfall::export_ {

struct MeshToExport {
    std::string name;
    std::vector<geometry::Vec3> positions;  ///< metres
    std::vector<geometry::Vec3> normals;    ///< unit vectors, one per vertex
    std::vector<geometry::Face> faces;
    std::vector<std::array<geometry::Vec2, 4>>
        corner_uvs;                           ///< one per face or empty; (0, 0) is the lower left
    std::vector<take::Attribute> attributes;  ///< on the vertices, as the take has them
};

/// How a mesh looks in formats that carry a material.
struct ExportMaterial {
    std::array<double, 3> base_colour = {0.8, 0.8, 0.8};  ///< linear light, 0 .. 1
    double roughness = 0.5;
};

/// Names for the scalar parts of an attribute: the name itself where there is one, else name_x, name_y ...
/// (up to four) or name_0, name_1 ... Characters other than letters, digits and '_' become '_'.
std::vector<std::string> component_names(const take::Attribute& attribute);

}  // namespace windfall::export_
