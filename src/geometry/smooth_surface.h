#pragma once
// The part of a closed surface's displacement that varies slowly over it, and the depth of wrinkles below
// that.
#include <Eigen/Cholesky>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

/// Least-squares projection of vector fields on a closed surface onto spherical harmonics up to degree 4 of
/// the vertices' directions. On the unit sphere these are spanned by the monomials of degree 3 and 4 (10 +
/// 15).
class SlowField {
  public:
    static constexpr int kDegree = 4;
    static constexpr int kFunctions = 25;

    /// `directions`: unit vector of each vertex; `weights`: its area.
    SlowField(const std::vector<Vec3>& directions, const std::vector<double>& weights);
    /// `more`: further functions, values [vertex, function] of about 1; they may depend on each other and on
    /// the harmonics.
    SlowField(const std::vector<Vec3>& directions, const std::vector<double>& weights,
              const Eigen::MatrixXd& more);

    std::vector<Vec3> project(const std::vector<Vec3>& field) const;

  private:
    Eigen::MatrixXd m_basis;
    Eigen::VectorXd m_weights;
    Eigen::LDLT<Eigen::MatrixXd> m_normal_equations;
};

/// Depth of each vertex below the smooth surface rest + slow part of (positions - rest), along that surface's
/// normal: positive in valleys, negative on ridges.
std::vector<double> depth_below_smooth_surface(const SlowField& slow, const std::vector<Vec3>& rest,
                                               const std::vector<Vec3>& positions,
                                               const std::vector<Face>& faces);

}  // namespace windfall::geometry
