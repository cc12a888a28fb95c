#include "drying/plastic_set.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "drying/element.h"

namespace windfall::drying {

namespace {

constexpr std::size_t kOfElement = 6;

Eigen::Matrix3d set_of_element(const PlasticSet& set, std::size_t element) {
    const double* c = set.data() + kOfElement * element;
    Eigen::Matrix3d result;
    result << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    return result;
}

/// The deviator of the logarithms of principal squares, halved: principal strains.
Eigen::Vector3d deviatoric_strains(const Eigen::Vector3d& squares) {
    const Eigen::Vector3d strains = 0.5 * squares.array().log().matrix();
    return strains - Eigen::Vector3d::Constant(strains.mean());
}

double equivalent(const Eigen::Vector3d& deviator) { return std::sqrt(2.0 / 3 * deviator.squaredNorm()); }

}  // namespace

Eigen::Matrix3d stress_free_stretch(const Eigen::Matrix3d& drying, const Eigen::Matrix3d& set) {
    // Exactly Fd where nothing has flowed: rounding must not leak in.
    if (set == Eigen::Matrix3d::Identity()) return drying;
    const Eigen::Matrix3d square = drying * set * drying;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square).operatorSqrt();
}

Eigen::Matrix3d set_after_flow(const Eigen::Matrix3d& deformation, const Eigen::Matrix3d& drying,
                               const Eigen::Matrix3d& set, double yield_strain) {
    const Eigen::Matrix3d stretch = stress_free_stretch(drying, set);
    const Eigen::Matrix3d elastic = deformation * stretch.inverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(elastic.transpose() * elastic);
    // An element that is inverted on the mean has no logarithmic strain; its energy has none either.
    if (!(principal.eigenvalues()[0] > 0)) return set;
    const Eigen::Vector3d deviator = deviatoric_strains(principal.eigenvalues());
    const double strain = equivalent(deviator);
    if (!(strain > yield_strain)) return set;
    const Eigen::Vector3d flowed = (2 * (1 - yield_strain / strain) * deviator).array().exp();
    const Eigen::Matrix3d& directions = principal.eigenvectors();
    const Eigen::Matrix3d to_set = stretch * drying.inverse();
    const Eigen::Matrix3d result =
        to_set.transpose() * directions * flowed.asDiagonal() * directions.transpose() * to_set;
    return 0.5 * (result + result.transpose()) / std::cbrt(result.determinant());
}

double equivalent_elastic_strain(const Eigen::Matrix3d& elastic) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(elastic.transpose() * elastic,
                                                                   Eigen::EigenvaluesOnly);
    return equivalent(deviatoric_strains(principal.eigenvalues()));
}

DryingField with_set(DryingField drying, const PlasticSet& set, int layers) {
    if (set.empty()) return drying;
    return [drying = std::move(drying), &set, layers](std::size_t quad, int layer) {
        const std::size_t element = quad * static_cast<std::size_t>(layers) + static_cast<std::size_t>(layer);
        return stress_free_stretch(drying(quad, layer), set_of_element(set, element));
    };
}

void flow(PlasticSet& set, const geometry::LayeredMesh& mesh, const std::vector<geometry::Vec3>& nodes,
          const DryingField& drying, const YieldStrains& yield) {
    constexpr std::size_t kQuadBlock = 64;
    const std::size_t quads = mesh.brick.quads.size();
    const auto layers = static_cast<std::size_t>(mesh.layers);
    if (set.empty()) {
        set.assign(kOfElement * quads * layers, 0);
        for (std::size_t e = 0; e < quads * layers; ++e)
            for (const std::size_t diagonal : {0U, 3U, 5U}) set[kOfElement * e + diagonal] = 1;
    }
    geometry::LayeredMesh now = mesh;
    now.nodes = nodes;
    parallel_blocks(quads, kQuadBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q)
            for (int k = 0; k < mesh.layers; ++k) {
                const double own = k < mesh.flesh_layers ? yield.flesh : yield.skin;
                if (own == 0) continue;
                const Eigen::Matrix3d deformation =
                    mean_deformation(element_nodes(mesh, q, k), element_nodes(now, q, k));
                const std::size_t element = q * layers + static_cast<std::size_t>(k);
                const Eigen::Matrix3d c =
                    set_after_flow(deformation, drying(q, k), set_of_element(set, element), own);
                const double entries[kOfElement] = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
                std::copy(entries, entries + kOfElement, set.data() + kOfElement * element);
            }
    });
}

}  // namespace windfall::drying
