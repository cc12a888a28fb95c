#include "geometry/smooth_surface.h"

#include <cmath>

namespace windfall::geometry {

SlowField::SlowField(const std::vector<Vec3>& directions, const std::vector<double>& weights)
    : SlowField(directions, weights, Eigen::MatrixXd()) {}

SlowField::SlowField(const std::vector<Vec3>& directions, const std::vector<double>& weights,
                     const Eigen::MatrixXd& more)
    : m_basis(directions.size(), kFunctions + more.cols()),
      m_weights(
          Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()))) {
    for (Eigen::Index v = 0; v < m_basis.rows(); ++v) {
        const Vec3& d = directions[v];
        int f = 0;
        for (int degree = kDegree - 1; degree <= kDegree; ++degree)
            for (int i = 0; i <= degree; ++i)
                for (int j = 0; i + j <= degree; ++j)
                    m_basis(v, f++) =
                        std::pow(d.x(), i) * std::pow(d.y(), j) * std::pow(d.z(), degree - i - j);
    }
    Eigen::MatrixXd products =
        m_basis.leftCols(kFunctions).transpose() * m_weights.asDiagonal() * m_basis.leftCols(kFunctions);
    if (more.cols() > 0) {
        m_basis.rightCols(more.cols()) = more;
        products = m_basis.transpose() * m_weights.asDiagonal() * m_basis;
        // Functions that depend on others then add nothing instead of dividing by nothing.
        constexpr double kIndependent = 1e-10;
        products.diagonal().array() += kIndependent * m_weights.sum();
    }
    m_normal_equations.compute(products);
}

std::vector<Vec3> SlowField::project(const std::vector<Vec3>& field) const {
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> values(
        field.front().data(), static_cast<Eigen::Index>(field.size()), 3);
    // Products of whole matrices: Eigen is slow on expressions of them.
    const Columns weighted = m_weights.asDiagonal() * values;
    const Columns right = m_basis.transpose() * weighted;
    const Columns coefficients = m_normal_equations.solve(right);
    const Columns slow = m_basis * coefficients;
    std::vector<Vec3> result(field.size());
    for (std::size_t v = 0; v < field.size(); ++v)
        result[v] = slow.row(static_cast<Eigen::Index>(v)).transpose();
    return result;
}

std::vector<double> depth_below_smooth_surface(const SlowField& slow, const std::vector<Vec3>& rest,
                                               const std::vector<Vec3>& positions,
                                               const std::vector<Face>& faces) {
    std::vector<Vec3> displacement(rest.size());
    for (std::size_t v = 0; v < rest.size(); ++v) displacement[v] = positions[v] - rest[v];
    std::vector<Vec3> smooth = slow.project(displacement);
    for (std::size_t v = 0; v < rest.size(); ++v) smooth[v] += rest[v];
    const std::vector<Vec3> normals = vertex_normals(smooth, faces);
    std::vector<double> depth(rest.size());
    for (std::size_t v = 0; v < rest.size(); ++v) depth[v] = (smooth[v] - positions[v]).dot(normals[v]);
    return depth;
}

}  // namespace windfall::geometry
