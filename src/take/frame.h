#pragma once
// One moment of a specimen, as every process emits it and every reader gets it.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::take {

/// Values on the vertices of a mesh: `values[components * vertex + component]`.
struct Attribute {
    std::string name;
    int components = 1;
    std::vector<float> values;
};

/// A mesh at one moment. Vertex order and faces are those of the take's mesh of the same name, in all frames.
struct FrameMesh {
    std::string name;  ///< drying: "skin", the outer surface of the fruit
    std::vector<Eigen::Vector3f> positions;
    std::vector<Attribute> attributes;

    const Attribute* find(const std::string& attribute) const {
        for (const auto& a : attributes)
            if (a.name == attribute) return &a;
        return nullptr;
    }
};

/// A picture on the skin, found by a mesh's texture coordinates (u to the right, v up, so v = 1 is the top
/// row). `values[components * (width * row + column) + component]`, the top row first; 0 stands for
/// `minimum`, 65535 for `maximum`. Every map of a frame has another (mesh, name).
struct FrameMap {
    std::string name;  ///< decay: "nutrient", "fungus", "fungus_active", "soft_rot", "base_color", ...
    std::string mesh;  ///< whose texture coordinates; empty: those of the take's only mesh
    int width = 0, height = 0;
    int components = 1;                 ///< 1, 3 (red, green, blue) or 4 (and alpha)
    double minimum = 0, maximum = 1;    ///< in the map's own unit
    bool srgb = false;                  ///< colours on the sRGB curve; else values are linear
    std::vector<std::uint16_t> values;  ///< width * height * components
};

/// Hair on the skin: strands of equally many points, from the root to the tip. Lengths in the take's unit.
struct FrameCurves {
    std::string name;                      ///< decay: "mold", "sporangia"
    std::string mesh;                      ///< which mesh the roots are on
    int points_per_strand = 2;             ///< 2 .. 64
    std::vector<Eigen::Vector3f> points;   ///< points_per_strand of each strand, one strand after the other
    std::vector<float> radii;              ///< one a strand
    std::vector<Eigen::Vector3f> colours;  ///< one a strand: linear red, green, blue
    std::vector<std::int32_t> numbers;     ///< one a strand, ascending: the same strand in all frames
    std::vector<std::int32_t> faces;       ///< of the mesh, where the root is
    std::vector<Eigen::Vector2f> face_places;  ///< (s, t) in that face; see face_weights()

    std::size_t strand_count() const { return radii.size(); }
};

/// Weights of a face's corners at (s, t): bilinear in a quadrilateral, where corners 0, 1, 2, 3 are (0, 0),
/// (1, 0), (1, 1), (0, 1); in a triangle corners 0, 1, 2 are (0, 0), (1, 0), (0, 1) and the last weight is 0.
inline std::array<float, 4> face_weights(const geometry::Face& face, float s, float t) {
    if (geometry::corner_count(face) == 3) return {1 - s - t, s, t, 0};
    return {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
}

/// One moment. Lengths are in the take's unit (TakeInfo::unit_length_m gives its metres).
struct Frame {
    int index = 0;
    double time = 0;                        ///< process time; drying: the whole drying takes one unit
    std::map<std::string, double> scalars;  ///< "shrinkage", "flesh_volume_ratio", ...
    std::vector<FrameMesh> meshes;
    std::vector<FrameMap> maps = {};
    std::vector<FrameCurves> curves = {};

    const FrameMap* find_map(const std::string& mesh, const std::string& name) const {
        for (const auto& map : maps)
            if (map.mesh == mesh && map.name == name) return &map;
        return nullptr;
    }
};

/// What some of the faces of a mesh are made of (fracture: "bark", "end_grain", "fibres" ...).
struct Material {
    std::string name;
    bool hard =
        false;  ///< shaded with the normals of the faces, edges crisp; else with those of the vertices
};

/// What does not change over the frames of a mesh: its fresh shape, faces and texture coordinates, materials,
/// and constant attributes on the vertices (drying: "direction", the unit vector of the vertex on the
/// parameter sphere; fracture: "tissue", "height", "thorn", "bundle" and "colour", three floats, linear RGB).
struct TakeMesh {
    std::string name;
    geometry::SurfaceMesh rest;
    std::vector<Attribute> attributes;
    std::vector<Material> materials;           ///< at most 256; empty: one smooth material (drying)
    std::vector<std::uint8_t> face_materials;  ///< per face its place in `materials`; empty when that is

    const Attribute* find(const std::string& attribute) const {
        for (const auto& a : attributes)
            if (a.name == attribute) return &a;
        return nullptr;
    }
};

}  // namespace windfall::take
