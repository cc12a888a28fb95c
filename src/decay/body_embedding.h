#pragma once
// How the fine skin rides on the coarse surface of the flesh: every coarse vertex carries an affine map (its
// place and its deformation gradient), and a skin vertex blends those of its four corners. Weights with zero
// slope at the cells' edges make the blend smooth across them: bilinear ones would show the cells as facets.
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "geometry/brick_surface.h"

namespace windfall::decay {

class BodyEmbedding {
  public:
    /// Both surfaces are cubes mapped by the same function; `coarse_positions` and `fine_positions` are
    /// fresh.
    BodyEmbedding(const geometry::BrickSurface& coarse, const std::vector<geometry::Vec3>& coarse_positions,
                  const geometry::BrickSurface& fine, const std::vector<geometry::Vec3>& fine_positions);

    /// Places of the fine vertices. `positions` and `gradients` per coarse vertex; more positions are
    /// ignored.
    void map(const std::vector<Eigen::Vector4f>& positions, const std::vector<Eigen::Matrix3f>& gradients,
             std::vector<Eigen::Vector3f>& result) const;

    /// Means of a fine field around each coarse vertex.
    std::vector<float> coarsen(std::span<const float> fine) const;

  private:
    struct Corners {
        std::array<std::int32_t, 4> vertex{};
        std::array<float, 4> weight{};
        std::array<Eigen::Vector3f, 4> offset;  ///< from the coarse vertex, fresh
    };
    std::vector<Corners> m_corners;
    std::vector<float> m_coarse_weight;
};

}  // namespace windfall::decay
