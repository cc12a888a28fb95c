#pragma once
// Adds faces to a part of a mesh behind what it has.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshfile/mesh.h"

namespace windfall::meshfile {

/// A corner of a new face: one of the old mesh (then its vertex and values stay those), or a new place with
/// values for all attributes, as `corner_values` gives them.
struct NewCorner {
    std::ptrdiff_t old_corner = -1;
    std::int32_t place = -1;
    const double* values = nullptr;
};

/// Corners at one place with the same values share a vertex where the format lets them, as those of the file
/// do. New positions and values are rounded to 32 bits, which is what files hold.
class FaceAppender {
  public:
    /// `part` was made of `old_mesh` by `part_of`.
    FaceAppender(MeshPart& part, const Mesh& old_mesh);

    /// A position in the world; gives its number.
    std::int32_t add_place(const Vec3& world);
    Vec3 place(std::int32_t number) const { return m_places[static_cast<std::size_t>(number)]; }

    /// A face, counter-clockwise from outside in the world. `columns_from`: the old face whose face columns
    /// it takes over, -1: zeros.
    void add_face(const FaceInfo& info, std::span<const NewCorner> corners, std::ptrdiff_t columns_from);

  private:
    /// Numbers that belong to one place, each with the next one; -1 ends the list.
    struct Chain {
        std::vector<std::int32_t> first;                           // by place
        std::vector<std::pair<std::int32_t, std::int32_t>> links;  // number, next link
    };

    void add_corner(const NewCorner& corner, std::int32_t group);
    std::int32_t vertex_of(const NewCorner& corner, std::int32_t group);
    std::int32_t entry_of(std::size_t attribute, std::int32_t place, const double* values);
    bool is_vertex(std::int32_t vertex, std::int32_t group, const double* values) const;

    MeshPart& m_part;
    const Mesh& m_old;
    std::vector<Vec3> m_places;
    std::vector<Eigen::Affine3d> m_from_world;  // one a group
    Chain m_vertices;
    std::vector<Chain> m_entries;  // one an attribute
};

}  // namespace windfall::meshfile
