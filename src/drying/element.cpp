#include "drying/element.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace windfall::drying {

namespace {

using Gradients = Eigen::Matrix<double, 8, 3>;

/// Derivatives of the trilinear shape functions at integration point g with respect to the parent
/// coordinates.
Gradients shape_gradients(int g) {
    static const double kSigns[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    const double point = 1 / std::sqrt(3.0);
    const double xi[3] = {g & 1 ? point : -point, g & 2 ? point : -point, g & 4 ? point : -point};
    Gradients result;
    for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int k = (i + 2) % 3;
            result(a, i) = kSigns[a][i] * (1 + kSigns[a][j] * xi[j]) * (1 + kSigns[a][k] * xi[k]) / 8;
        }
    return result;
}

Eigen::Matrix3d jacobian(const HexNodes& nodes, const Gradients& gradients) {
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) result += nodes[a] * gradients.row(a);
    return result;
}

}  // namespace

HexNodes element_nodes(const geometry::LayeredMesh& mesh, std::size_t quad, int layer) {
    HexNodes nodes;
    for (int c = 0; c < 4; ++c) {
        nodes[c] = mesh.node(mesh.brick.quads[quad][c], layer);
        nodes[4 + c] = mesh.node(mesh.brick.quads[quad][c], layer + 1);
    }
    return nodes;
}

double hexahedron_volume(const HexNodes& nodes) {
    double volume = 0;
    for (int g = 0; g < 8; ++g) volume += jacobian(nodes, shape_gradients(g)).determinant();
    return volume;
}

Eigen::Matrix3d mean_deformation(const HexNodes& rest, const HexNodes& now) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double volume = 0;
    for (int g = 0; g < 8; ++g) {
        const Gradients gradients = shape_gradients(g);
        const Eigen::Matrix3d rest_jacobian = jacobian(rest, gradients);
        const double w = rest_jacobian.determinant();
        sum += w * jacobian(now, gradients) * rest_jacobian.inverse();
        volume += w;
    }
    return sum / volume;
}

HexResponse hexahedron_response(const HexNodes& rest, const HexNodes& now, const HexMaterial& material) {
    HexResponse response;
    response.gradient.setZero();
    response.hessian.setZero();
    const Eigen::Matrix3d inv_drying = material.drying.inverse();
    const double jd = material.drying.determinant();
    double rest_volume = 0;
    double volume = 0;
    Eigen::Matrix<double, 24, 1> volume_gradient = Eigen::Matrix<double, 24, 1>::Zero();
    Eigen::Matrix<double, 24, 24> volume_hessian = Eigen::Matrix<double, 24, 24>::Zero();
    for (int g = 0; g < 8; ++g) {
        const Gradients gradients = shape_gradients(g);
        const Eigen::Matrix3d rest_jacobian = jacobian(rest, gradients);
        const Eigen::Matrix3d now_jacobian = jacobian(now, gradients);
        const double w = rest_jacobian.determinant();
        const double w_now = now_jacobian.determinant();
        const Eigen::Matrix3d elastic = now_jacobian * rest_jacobian.inverse() * inv_drying;
        // dN/dX Fd^-1 and dN/dx
        const Gradients to_dried = gradients * rest_jacobian.inverse() * inv_drying;
        const Gradients to_now = gradients * now_jacobian.inverse();
        const double mu = material.shear * jd * w;
        // F p, whose square is I4, and Young's modulus E times the dried volume
        const Eigen::Vector3d fibre = now_jacobian * rest_jacobian.inverse() * material.fibre;
        const Eigen::Matrix<double, 8, 1> along = gradients * rest_jacobian.inverse() * material.fibre;
        const double excess = fibre.squaredNorm() - 1;
        const double modulus = material.fibre_modulus * jd * w;
        response.energy += modulus / 8 * excess * excess;
        response.energy += mu * (0.5 * (elastic.squaredNorm() - 3) - std::log(elastic.determinant()));
        for (int a = 0; a < 8; ++a) {
            const Eigen::Vector3d force =
                mu * (elastic * to_dried.row(a).transpose() - to_now.row(a).transpose());
            response.gradient.segment<3>(3 * a) += force + modulus / 2 * excess * along[a] * fibre;
            volume_gradient.segment<3>(3 * a) += w_now * to_now.row(a).transpose();
            for (int b = 0; b < 8; ++b) {
                const Eigen::Matrix3d ab = to_now.row(a).transpose() * to_now.row(b);
                response.hessian.block<3, 3>(3 * a, 3 * b) +=
                    mu *
                    (to_dried.row(a).dot(to_dried.row(b)) * Eigen::Matrix3d::Identity() + ab.transpose());
                response.hessian.block<3, 3>(3 * a, 3 * b) +=
                    modulus / 2 * along[a] * along[b] *
                    (excess * Eigen::Matrix3d::Identity() + 2 * fibre * fibre.transpose());
                volume_hessian.block<3, 3>(3 * a, 3 * b) += w_now * (ab - ab.transpose());
            }
        }
        rest_volume += w;
        volume += w_now;
    }
    const double dried = rest_volume * jd;
    const double dilatation = volume / dried - 1;
    response.energy += 0.5 * material.bulk * dried * dilatation * dilatation;
    response.gradient += material.bulk * dilatation * volume_gradient;
    response.hessian +=
        material.bulk * (dilatation * volume_hessian + volume_gradient * volume_gradient.transpose() / dried);
    return response;
}

HexState hexahedron_state(const HexNodes& rest, const HexNodes& now, const HexMaterial& material) {
    HexState state;
    state.drying_volume_ratio = material.drying.determinant();
    bool first = true;
    for (int g = 0; g < 8; ++g) {
        const Gradients gradients = shape_gradients(g);
        const Eigen::Matrix3d rest_jacobian = jacobian(rest, gradients);
        const Eigen::Matrix3d now_jacobian = jacobian(now, gradients);
        const double w = rest_jacobian.determinant();
        const double w_now = now_jacobian.determinant();
        const double elastic = w_now / (w * state.drying_volume_ratio);
        const Eigen::Matrix3d fe = now_jacobian * rest_jacobian.inverse() * material.drying.inverse();
        // mu / J (Fe Fe^T - I), summed over the current volume
        state.stress += material.shear * w * state.drying_volume_ratio *
                        (fe * fe.transpose() - Eigen::Matrix3d::Identity());
        // E / 2 (I4 - 1) (F p)(F p)^T / J
        const Eigen::Vector3d fibre = now_jacobian * rest_jacobian.inverse() * material.fibre;
        state.stress += material.fibre_modulus / 2 * w * state.drying_volume_ratio *
                        (fibre.squaredNorm() - 1) * fibre * fibre.transpose();
        state.smallest_elastic = first ? elastic : std::min(state.smallest_elastic, elastic);
        state.largest_elastic = first ? elastic : std::max(state.largest_elastic, elastic);
        state.rest_volume += w;
        state.volume += w_now;
        first = false;
    }
    state.elastic_volume_ratio = state.volume / (state.rest_volume * state.drying_volume_ratio);
    state.stress = state.stress / state.volume +
                   material.bulk * (state.elastic_volume_ratio - 1) * Eigen::Matrix3d::Identity();
    state.pressure = -material.bulk * (state.elastic_volume_ratio - 1);
    return state;
}

}  // namespace windfall::drying
