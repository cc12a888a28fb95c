#pragma once
// One group of tetrahedra, one in each lane of a vector register: energy, forces, rotations.
#include <array>
#include <cmath>

namespace windfall::decay {

template <class Real>
struct FleshLanes;
template <>
struct FleshLanes<float> {
    using V = float __attribute__((vector_size(32)));
};
template <>
struct FleshLanes<double> {
    using V = double __attribute__((vector_size(32)));
};

/// In: edge vectors as the columns of `edges`. Out: forces on vertices 1..3 as its columns (the gradient, not
/// its negative). All 3 x 3 arrays run row by row.
template <class V>
struct FleshGroup {
    V edges[9];
    V energy;
};

template <class V>
inline V lane_abs(V a) {
    return a < 0 ? -a : a;
}

template <class V>
inline V lane_inverse_sqrt(V a) {
    for (unsigned i = 0; i < sizeof(V) / sizeof(a[0]); ++i) a[i] = 1 / std::sqrt(a[i]);
    return a;
}

template <class V>
inline void rotation_of(const V q[4], V R[9]) {
    const V x = q[0], y = q[1], z = q[2], w = q[3];
    R[0] = 1 - 2 * (y * y + z * z);
    R[1] = 2 * (x * y - z * w);
    R[2] = 2 * (x * z + y * w);
    R[3] = 2 * (x * y + z * w);
    R[4] = 1 - 2 * (x * x + z * z);
    R[5] = 2 * (y * z - x * w);
    R[6] = 2 * (x * z - y * w);
    R[7] = 2 * (y * z + x * w);
    R[8] = 1 - 2 * (x * x + y * y);
}

/// One step of Mueller et al. 2016, equation (6): turns R about sum r_c x f_c / |sum r_c . f_c|. The
/// quaternion (axis angle / 2, 1) of small angles replaces the exponential.
template <class V>
inline void turn_towards(const V F[9], const V R[9], V q[4]) {
    V omega[3] = {}, dot = {};
    for (int c = 0; c < 3; ++c) {
        const V rx = R[c], ry = R[3 + c], rz = R[6 + c];
        const V fx = F[c], fy = F[3 + c], fz = F[6 + c];
        omega[0] += ry * fz - rz * fy;
        omega[1] += rz * fx - rx * fz;
        omega[2] += rx * fy - ry * fx;
        dot += rx * fx + ry * fy + rz * fz;
    }
    const V scale = 1 / (2 * lane_abs(dot) + V{} + 1e-6F);
    const V ox = omega[0] * scale, oy = omega[1] * scale, oz = omega[2] * scale;
    const V x = q[0] + ox * q[3] + oy * q[2] - oz * q[1];
    const V y = q[1] + oy * q[3] + oz * q[0] - ox * q[2];
    const V z = q[2] + oz * q[3] + ox * q[1] - oy * q[0];
    const V w = q[3] - ox * q[0] - oy * q[1] - oz * q[2];
    const V inverse = lane_inverse_sqrt(x * x + y * y + z * z + w * w);
    q[0] = x * inverse;
    q[1] = y * inverse;
    q[2] = z * inverse;
    q[3] = w * inverse;
}

/// `inverse_rest`: 9; `material`: V theta, theta, 2 mu, lambda; `q`: the quaternion, turned `rotation_steps`
/// times first.
template <class V>
inline void flesh_group(FleshGroup<V>& group, const V* inverse_rest, const V* material, V* q,
                        int rotation_steps) {
    const V* B = inverse_rest;
    V* D = group.edges;
    V F[9], R[9];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            F[3 * r + c] = D[3 * r] * B[c] + D[3 * r + 1] * B[3 + c] + D[3 * r + 2] * B[6 + c];
    rotation_of(q, R);
    for (int step = 0; step < rotation_steps; ++step) {
        turn_towards(F, R, q);
        rotation_of(q, R);
    }
    const V weight = material[0], theta = material[1], two_mu = material[2], lambda = material[3];
    V trace = -3 * theta;
    for (int k = 0; k < 9; ++k) trace += R[k] * F[k];
    V squares = {};
    V P[9];
    for (int k = 0; k < 9; ++k) {
        const V difference = F[k] - theta * R[k];
        squares += difference * difference;
        P[k] = weight * (two_mu * difference + lambda * trace * R[k]);
    }
    group.energy = weight * (two_mu * squares + lambda * trace * trace) / 2;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            D[3 * r + c] = P[3 * r] * B[3 * c] + P[3 * r + 1] * B[3 * c + 1] + P[3 * r + 2] * B[3 * c + 2];
}

}  // namespace windfall::decay
