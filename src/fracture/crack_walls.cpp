#include "fracture/crack_walls.h"

#include <algorithm>
#include <numbers>

namespace windfall::fracture {
namespace {

constexpr double kUnitOfWalls = 2 * std::numbers::pi;  // radii

void add_wall_face(const WallColumn& a, const WallColumn& b, int row, bool is_left, bool downwards,
                   BranchMesh& mesh) {
    const auto vertex = [&](const WallColumn& column, int at) {
        const auto& side = is_left ? column.left : column.right;
        return side[std::min(static_cast<std::size_t>(at), side.size() - 1)];
    };
    const auto uv = [&](const WallColumn& column, std::int32_t v) {
        return Vector2f(static_cast<float>(column.arc / kUnitOfWalls),
                        static_cast<float>(mesh.height[static_cast<std::size_t>(v)] / kUnitOfWalls));
    };
    geometry::Face v{vertex(a, row), vertex(a, row + 1), vertex(b, row + 1), vertex(b, row)};
    std::array<Vector2f, 4> uvs{uv(a, v[0]), uv(a, v[1]), uv(b, v[2]), uv(b, v[3])};
    // Seen along the crack, the left wall faces right: forwards is from its right to its left when it is
    // looked at with the surface up.
    if (is_left != downwards) {
        std::swap(v[1], v[3]);
        std::swap(uvs[1], uvs[3]);
    }
    add_face(v, uvs, Part::Crack, mesh);
}

}  // namespace

void add_wall_faces(const WallColumn& a, const WallColumn& b, int rows, bool downwards, BranchMesh& mesh) {
    for (int row = 0; row < rows; ++row)
        for (const bool is_left : {true, false}) add_wall_face(a, b, row, is_left, downwards, mesh);
}

void add_face(const geometry::Face& corners, const std::array<Vector2f, 4>& uvs, Part part,
              BranchMesh& mesh) {
    geometry::Face face;
    face.fill(geometry::kNoVertex);
    std::array<Vector2f, 4> kept;
    kept.fill(Vector2f::Zero());
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (corners[k] == corners[(k + 3) % 4]) continue;
        face[count] = corners[k];
        kept[count++] = uvs[k];
    }
    mesh.faces.push_back(face);
    mesh.corner_uvs.push_back(kept);
    mesh.parts.push_back(part);
}

}  // namespace windfall::fracture
