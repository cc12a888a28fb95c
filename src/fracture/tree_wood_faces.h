#pragma once
#include <array>
#include <vector>

#include "fracture/tree_part.h"

namespace windfall::fracture {

/// The faces of the broken surface, as the artist's file holds faces: its texture coordinates, normals and
/// colours where it has them. glTF gets the colours of the wood in any case, others the mean of each part as
/// the material's.
class WoodFaces {
  public:
    /// Appends materials (and, in glTF, groups) to `target`, which the faces will go to.
    WoodFaces(const TreePartPlan& plan, const FittedWood& wood, std::int32_t group, meshfile::Mesh& target);

    /// `places` has the numbers of those vertices that the appender knows already, else -1.
    void add(meshfile::FaceAppender& appender, std::vector<std::int32_t>& places) const;

  private:
    void fill(std::size_t face, std::size_t corner, double* values) const;

    const FittedWood& m_wood;
    const meshfile::Mesh& m_target;
    std::vector<std::array<Vector3f, 4>> m_normals;
    std::vector<Vector3f> m_colours;
    std::array<meshfile::FaceInfo, kPartCount> m_info;
    Eigen::Matrix3d m_normal_from_world;
    bool m_is_gltf;
    double m_colour_scale = 1;
};

}  // namespace windfall::fracture
