#pragma once
// What every format writes: the meshes of a take at one moment, in metres, Y up.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"
#include "take/frame.h"

namespace windfall::export_ {

/// How some faces look in formats that carry a material.
struct ExportMaterial {
    std::string name;
    std::array<double, 3> base_colour = {0.8, 0.8, 0.8};  ///< linear light, 0 .. 1: on the average
    double roughness = 0.5;
    bool hard = false;  ///< shaded with the normals of the faces
};

/// Vertices that formats cannot do without normals for, as they lie at one moment.
struct Shape {
    std::vector<geometry::Vec3> positions;  ///< metres
    std::vector<geometry::Vec3> normals;    ///< unit vectors, one per vertex, of the smooth faces around it
    std::vector<geometry::Vec3> face_normals;  ///< unit vectors, one per face; empty when no material is hard
};

struct MeshToExport : Shape {
    std::string name;
    std::vector<geometry::Face> faces;
    std::vector<std::array<geometry::Vec2, 4>>
        corner_uvs;                           ///< one per face or empty; (0, 0) is the lower left
    std::vector<take::Attribute> attributes;  ///< on the vertices, as the take has them
    std::vector<ExportMaterial> materials{ExportMaterial{}};  ///< at least one
    std::vector<std::uint8_t> face_materials;                 ///< per face; empty: all have the first

    std::size_t material_of(std::size_t face) const {
        return face_materials.empty() ? 0 : face_materials[face];
    }
    std::vector<bool> used_materials() const;  ///< those that a face is of
    bool has_hard_faces() const;
    /// The attribute "colour" (linear red, green, blue), which formats have a place of its own for, or null.
    const take::Attribute* colour() const;
};

/// Names for the scalar parts of an attribute: the name itself where there is one, else name_x, name_y ...
/// (up to four) or name_0, name_1 ... Characters other than letters, digits and '_' become '_'.
std::vector<std::string> component_names(const take::Attribute& attribute);

/// Light as a display wants it, and back.
double srgb_from_linear(double linear);
double linear_from_srgb(double srgb);

}  // namespace windfall::export_
