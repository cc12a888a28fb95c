#pragma once
// One moment of a specimen, as every process emits it and every reader gets it.
#include <Eigen/Core>
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

/// One moment. Lengths are in the take's unit (TakeInfo::unit_length_m gives its metres).
struct Frame {
    int index = 0;
    double time = 0;                        ///< process time; drying: the whole drying takes one unit
    std::map<std::string, double> scalars;  ///< "shrinkage", "flesh_volume_ratio", ...
    std::vector<FrameMesh> meshes;
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
