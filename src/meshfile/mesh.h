#pragma once
// An artist's mesh as its file has it: every vertex, in the file's order, with whatever the file says of it.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace windfall::meshfile {

using Vec3 = Eigen::Vector3d;

enum class Format { Obj, Ply, Gltf, Glb };

/// What is behind a value that the file does not give for a vertex or corner, while it does for others.
inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

enum class Role { TextureCoordinate, Normal, Tangent, Colour, Other };

/// Values of one kind, `components` for each entry. An entry is a vertex, or, with `on_corners`, what the
/// corners of faces point to, as in OBJ.
struct Attribute {
    std::string name;  ///< the file's own: TEXCOORD_1, quality; "vt" and "vn" for OBJ
    Role role = Role::Other;
    int components = 1;
    std::vector<double> values;
    bool on_corners = false;
    std::vector<std::int32_t> corner_entries;  ///< one a corner, -1: none; empty unless on_corners
};

/// Faces that the file keeps together: an object or group of OBJ, a primitive of a node of glTF, all of PLY.
struct Group {
    std::string object, name;
    int node = -1, primitive = -1;  ///< of glTF
    Eigen::Affine3d to_world = Eigen::Affine3d::Identity();
    bool changed = false;  ///< false: the group has all the vertices and faces that it has in the file

    /// Whether the way to the world turns the faces over (glTF 2.0, 3.7.4: then so does their winding).
    bool mirrored() const { return to_world.linear().determinant() < 0; }
};

struct Material {
    std::string name;
    int source = -1;  ///< number in the file that was read; -1: new, and the values below describe it
    std::array<float, 3> base_colour = {0.8F, 0.8F, 0.8F};  ///< linear light
    float roughness = 0.8F;
};

struct FaceInfo {
    std::int32_t group = 0;
    std::int32_t material = -1;   ///< -1: none
    std::uint32_t smoothing = 0;  ///< OBJ's smoothing group; 0: none
};

/// One number a face, as PLY allows.
struct FaceColumn {
    std::string name;
    std::vector<double> values;
};

/// What else the file holds and what goes through untouched: textures, lights, comments. Each format has its
/// own.
struct Source {
    Format format;
    explicit Source(Format its_format) : format(its_format) {}
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
};

/// Polygons with any number of corners, counter-clockwise from outside (clockwise in mirrored groups).
struct Mesh {
    std::vector<Vec3> positions;              ///< as in the file: of glTF, before the node's transform
    std::vector<std::int32_t> vertex_groups;  ///< of glTF, where each vertex belongs to one group; else empty
    std::vector<std::size_t> face_starts{0};  ///< face f has the corners face_starts[f] .. face_starts[f + 1]
    std::vector<std::int32_t> corners;        ///< vertices
    std::vector<FaceInfo> faces;
    std::vector<FaceColumn> face_columns;
    std::vector<Attribute> attributes;
    std::vector<Group> groups;
    std::vector<Material> materials;
    std::shared_ptr<const Source> source;
    std::vector<std::string> warnings;  ///< what was in the file and will not be in the next one

    std::size_t face_count() const { return faces.size(); }
    std::size_t corner_count(std::size_t face) const { return face_starts[face + 1] - face_starts[face]; }
    /// Positions after the transforms of the groups.
    std::vector<Vec3> world_positions() const;
    /// How many numbers `corner_values` gives.
    std::size_t values_per_corner() const;
};

/// All attributes of a corner one after another, in the order of `mesh.attributes`; kAbsent where there is
/// none.
void corner_values(const Mesh& mesh, std::size_t corner, double* values);

/// Some of a mesh's faces and what became of the numbers.
struct MeshPart {
    Mesh mesh;
    std::vector<std::int32_t> vertex_of;              ///< new number by old one; -1: left out
    std::vector<std::vector<std::int32_t>> entry_of;  ///< the same for each attribute on corners, else empty
};

/// The faces f with keep_face[f], in their order, and the vertices (and entries of attributes) of their
/// corners and of the corners in `more_corners`, in their order. Nothing is changed but the numbers.
MeshPart part_of(const Mesh& mesh, const std::vector<bool>& keep_face,
                 const std::vector<std::size_t>& more_corners);

/// Throws InputError, with `name` of the file, when the mesh has no faces, when a corner points to no vertex,
/// when a position is not a finite number, or when an attribute or column has not got one entry for each.
void check(const Mesh& mesh, const std::string& name);

}  // namespace windfall::meshfile
