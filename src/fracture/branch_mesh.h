#pragma once
// The surface of one end of a broken branch, as artists want it: closed parts, materials, texture
// coordinates.
//
// Lengths are in radii of the branch at the break. Until it is placed (placing.h) a branch is a straight
// cylinder of radius 1 about the z axis, the break near z = 0, the stub below it and the fallen piece above.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::fracture {

using Eigen::Vector2f;
using Eigen::Vector3f;

enum class Tissue : std::uint8_t { Pith, Heartwood, Sapwood, Phloem, Bark };

/// What a face is made of; the names of the materials in files are those of `part_names`.
enum class Part : std::uint8_t { Bark, EndGrain, Fibres, Thorns, InnerBark, Crack };
inline constexpr int kPartCount = 6;

/// "bark", "end_grain", "fibres", "thorns", "inner_bark", "crack", in the order of Part.
const std::vector<std::string>& part_names();

/// Bark and end grain are shaded smooth, with the normals at the vertices; torn fibres, thorns and crack
/// walls hard, with those of the faces. A vertex belongs to smooth faces of one part at most: where bark
/// meets the break there is a narrow hard rim (Part::InnerBark) between them.
inline constexpr bool is_smooth(Part part) { return part == Part::Bark || part == Part::EndGrain; }

/// Closed, manifold and oriented: every edge lies between two faces that run through it in opposite ways.
/// Thorns, strands and strips are closed components of their own, rooted in the wood.
struct BranchMesh {
    // on the vertices
    std::vector<Vector3f> positions;
    std::vector<Vector3f> normals;  ///< of the smooth faces around; zero where there are none
    std::vector<float> height;      ///< z in the unplaced branch
    std::vector<float> thorn;       ///< 0 on the wood, along a thorn from 0 at its root to 1 at its tip
    std::vector<Tissue> tissue;
    std::vector<std::uint32_t> bundle;  ///< hash of the fibre bundle; equal on all of its vertices

    // on the faces
    std::vector<geometry::Face> faces;  ///< counter-clockwise from outside; a triangle ends in kNoVertex
    std::vector<Part> parts;
    std::vector<std::array<Vector2f, 4>> corner_uvs;
    std::vector<Vector3f> face_normals;

    std::size_t vertex_count() const { return positions.size(); }
    std::size_t face_count() const { return faces.size(); }
    /// Drops all vertices and faces and keeps the memory.
    void clear();
};

/// Puts `other` behind `mesh`; its face indices are shifted.
void append(BranchMesh& mesh, const BranchMesh& other);

/// Fills `normals` and `face_normals` from positions and faces.
void compute_normals(BranchMesh& mesh);

/// The same for a mesh whose first vertices and faces are those of `mesh` seen from behind: where a face has
/// the same corners (of equal height) its normals are taken over. `turned`: +-1 for each axis, how `reverse`
/// has been turned in space meanwhile.
void compute_reverse_normals(const BranchMesh& mesh, std::size_t shared_vertices, std::size_t shared_faces,
                             const Vector3f& turned, BranchMesh& reverse);

}  // namespace windfall::fracture
