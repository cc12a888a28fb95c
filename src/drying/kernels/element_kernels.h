// Energy, gradient and Hessian of the hexahedra: neo-Hookean, Q1P0 (mean dilatation). Included inside the
// namespace of one instruction set (see lanes.h).
//
// Per element, with J1 = dx/dxi, J0 = dX/dxi at the integration points g of the 2 x 2 x 2 rule, det Fd = Jd:
//   W = sum_g w0 [ mu Jd / 2 (F : F Fd^-1 Fd^-T - 3) - mu Jd ln(J / Jd) ] + V Jd kappa / 2 (Jbar - 1)^2
// where w0 = det J0, J = det J1 / det J0, V = sum w0 and Jbar = (sum det J1) / (V Jd) is the elastic mean
// dilatation. With G = w0 mu Jd J0^-1 (Fd^-1 Fd^-T) J0^-T the first term is tr(J1 G J1^T) / 2: the fresh
// shape enters by G alone.

/// Shape function derivatives with respect to the parent coordinates, at the integration points:
/// [g][node][axis]. Nodes 0..3 below, 4..7 above, counter-clockwise.
struct ShapeDerivatives {
    double d[8][8][3];
    /// det[D_a D_b D_c] summed over g: second derivative of the element's volume (see `assemble`).
    float triple[8][8][8];

    constexpr ShapeDerivatives() : d{}, triple{} {
        constexpr double kGauss = 0.57735026918962576451;  // 1 / sqrt(3)
        constexpr double kX[4] = {-1, 1, 1, -1};
        constexpr double kY[4] = {-1, -1, 1, 1};
        for (int g = 0; g < 8; ++g) {
            const double x = (g & 1 ? 1 : -1) * kGauss;
            const double y = (g & 2 ? 1 : -1) * kGauss;
            const double z = (g & 4 ? 1 : -1) * kGauss;
            for (int a = 0; a < 8; ++a) {
                const double sx = kX[a % 4];
                const double sy = kY[a % 4];
                const double sz = a < 4 ? -1 : 1;
                d[g][a][0] = sx * (1 + sy * y) * (1 + sz * z) / 8;
                d[g][a][1] = sy * (1 + sx * x) * (1 + sz * z) / 8;
                d[g][a][2] = sz * (1 + sx * x) * (1 + sy * y) / 8;
            }
        }
        for (int a = 0; a < 8; ++a)
            for (int b = 0; b < 8; ++b)
                for (int c = 0; c < 8; ++c) {
                    double sum = 0;
                    for (int g = 0; g < 8; ++g) {
                        const double* p = d[g][a];
                        const double* q = d[g][b];
                        const double* r = d[g][c];
                        sum += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                               p[2] * (q[0] * r[1] - q[1] * r[0]);
                    }
                    triple[a][b][c] = static_cast<float>(sum);
                }
    }
};

// Constant-initialised: no code of one instruction set may run before the choice between them is made.
static constexpr ShapeDerivatives kShape;

/// cofactors[3 i + j] = det(m) (m^-1)_ji; returns det(m).
template <class V>
inline V cofactor_matrix(const V m[9], V cofactors[9]) {
    cofactors[0] = m[4] * m[8] - m[5] * m[7];
    cofactors[1] = m[5] * m[6] - m[3] * m[8];
    cofactors[2] = m[3] * m[7] - m[4] * m[6];
    cofactors[3] = m[2] * m[7] - m[1] * m[8];
    cofactors[4] = m[0] * m[8] - m[2] * m[6];
    cofactors[5] = m[1] * m[6] - m[0] * m[7];
    cofactors[6] = m[1] * m[5] - m[2] * m[4];
    cofactors[7] = m[2] * m[3] - m[0] * m[5];
    cofactors[8] = m[0] * m[4] - m[1] * m[3];
    return m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2];
}

/// Fresh and current positions of the eight nodes of one quad's column of elements.
template <int L>
struct Nodes {
    using D = typename LaneTypes<L>::D;
    D rest[8][3];
    D now[8][3];

    Nodes(const ElementArrays& e, const double* displacement, int quad) {
        for (int c = 0; c < 4; ++c) {
            const int column = e.quads[quad][c];
            for (int i = 0; i < 3; ++i) {
                const D top =
                    *reinterpret_cast<const D*>(e.rest + (3 * static_cast<std::int64_t>(column) + i) * L);
                const D u = *reinterpret_cast<const D*>(displacement +
                                                        (3 * static_cast<std::int64_t>(column) + i) * L);
                D bottom = shift_up(top);
                bottom[0] = e.base[3 * static_cast<std::int64_t>(column) + i];
                rest[4 + c][i] = top;
                rest[c][i] = bottom;
                now[4 + c][i] = top + u;
                now[c][i] = bottom + shift_up(u);
            }
        }
    }
};

/// m[3 i + j] = sum_a x[a][i] D[g][a][j]
template <class V>
inline void jacobian(const V x[8][3], int g, V m[9]) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            V sum = x[0][i] * kShape.d[g][0][j];
            for (int a = 1; a < 8; ++a) sum += x[a][i] * kShape.d[g][a][j];
            m[3 * i + j] = sum;
        }
}

/// G of the comment above times 1 / (mu Jd), as xx, xy, xz, yy, yz, zz; returns w0.
template <class V>
inline V fresh_metric(const V rest_jacobian[9], const V inv_cd[6], V metric[6]) {
    V cof[9];
    const V w0 = cofactor_matrix(rest_jacobian, cof);
    const V inv_w0 = 1.0 / w0;
    // (J0^-1)_{ia} = cof_{ai} / w0; T = C J0^-T w0, then metric = J0^-1 T / w0 * w0 / w0.
    V t[9];
    for (int j = 0; j < 3; ++j) {
        t[j] = inv_cd[0] * cof[j] + inv_cd[1] * cof[3 + j] + inv_cd[2] * cof[6 + j];
        t[3 + j] = inv_cd[1] * cof[j] + inv_cd[3] * cof[3 + j] + inv_cd[4] * cof[6 + j];
        t[6 + j] = inv_cd[2] * cof[j] + inv_cd[4] * cof[3 + j] + inv_cd[5] * cof[6 + j];
    }
    int entry = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            metric[entry++] = (cof[i] * t[j] + cof[3 + i] * t[3 + j] + cof[6 + i] * t[6 + j]) * inv_w0;
    return w0;
}

/// out = m S for a symmetric S given by its upper triangle.
template <class V>
inline void times_symmetric(const V m[9], const V s[6], V out[9]) {
    for (int i = 0; i < 3; ++i) {
        out[3 * i] = m[3 * i] * s[0] + m[3 * i + 1] * s[1] + m[3 * i + 2] * s[2];
        out[3 * i + 1] = m[3 * i] * s[1] + m[3 * i + 1] * s[3] + m[3 * i + 2] * s[4];
        out[3 * i + 2] = m[3 * i] * s[2] + m[3 * i + 1] * s[4] + m[3 * i + 2] * s[5];
    }
}

template <int L, bool with_force>
inline EnergySums energy_of_quads(const ElementArrays& e, const double* displacement, double* force,
                                  Range quads) {
    using D = typename LaneTypes<L>::D;
    const D zero = D{};
    D energy = zero;
    D smallest = zero + 1e30;
    for (int quad = quads.begin; quad < quads.end; ++quad) {
        const Nodes<L> nodes(e, displacement, quad);
        const D mu = *reinterpret_cast<const D*>(e.shear + quad * e.moduli_stride);
        const D kappa = *reinterpret_cast<const D*>(e.bulk + quad * e.moduli_stride);
        const D* dehydration =
            reinterpret_cast<const D*>(e.dehydration + static_cast<std::int64_t>(quad) * 7 * L);
        const D jd = dehydration[0];
        const D mu_jd = mu * jd;
        const D inv_jd = 1.0 / jd;
        D stress[8][9];  // of the shear terms, times J1-space: R_a = sum_g stress_g D_a
        D cof[8][9];
        D rest_volume = zero;
        D volume = zero;
        D deviatoric = zero;
        for (int g = 0; g < 8; ++g) {
            D j0[9];
            D j1[9];
            D metric[6];
            jacobian(nodes.rest, g, j0);
            jacobian(nodes.now, g, j1);
            const D w0 = fresh_metric(j0, dehydration + 1, metric);
            const D w1 = cofactor_matrix(j1, cof[g]);
            const D ratio = w1 / w0;
            smallest = smallest < ratio ? smallest : ratio;
            D j1_metric[9];
            times_symmetric(j1, metric, j1_metric);
            D invariant = zero;
            for (int i = 0; i < 9; ++i) invariant += j1[i] * j1_metric[i];
            const D elastic = ratio * inv_jd;
            const D positive = elastic > 1e-30 ? elastic : zero + 1e-30;
            deviatoric += 0.5 * invariant - w0 * (1.5 + log_lanes<L>(positive));
            rest_volume += w0;
            volume += w1;
            if constexpr (with_force) {
                const D factor = w0 / w1;
                for (int i = 0; i < 9; ++i) stress[g][i] = mu_jd * (j1_metric[i] - factor * cof[g][i]);
            }
        }
        const D rest_dried = rest_volume * jd;
        const D dilatation = volume / rest_dried - 1.0;
        energy += mu_jd * deviatoric + 0.5 * kappa * rest_dried * dilatation * dilatation;
        if constexpr (with_force) {
            const D pressure = kappa * dilatation;
            D result[8][3];
            for (int a = 0; a < 8; ++a)
                for (int i = 0; i < 3; ++i) result[a][i] = zero;
            for (int g = 0; g < 8; ++g) {
                D q[9];
                for (int i = 0; i < 9; ++i) q[i] = stress[g][i] + pressure * cof[g][i];
                for (int a = 0; a < 8; ++a)
                    for (int i = 0; i < 3; ++i)
                        result[a][i] += q[3 * i] * kShape.d[g][a][0] + q[3 * i + 1] * kShape.d[g][a][1] +
                                        q[3 * i + 2] * kShape.d[g][a][2];
            }
            for (int c = 0; c < 4; ++c)
                for (int i = 0; i < 3; ++i) {
                    D* f = reinterpret_cast<D*>(force +
                                                (3 * static_cast<std::int64_t>(e.quads[quad][c]) + i) * L);
                    *f += result[4 + c][i] + shift_down(result[c][i]);
                }
        }
    }
    EnergySums sums;
    sums.energy = sum_of_lanes(energy);
    sums.smallest_volume_ratio = 1e30;
    for (int k = 0; k < L; ++k)
        if (!(smallest[k] >= sums.smallest_volume_ratio)) sums.smallest_volume_ratio = smallest[k];
    return sums;
}

template <int L>
EnergySums energy(const ElementArrays& e, const double* displacement, double* force, Range quads) {
    return force != nullptr ? energy_of_quads<L, true>(e, displacement, force, quads)
                            : energy_of_quads<L, false>(e, displacement, nullptr, quads);
}

/// What the blocks of one column of elements are computed from, in single precision.
template <int L>
struct TangentData {
    using F = typename LaneTypes<L>::F;
    F h[8][8][3];      ///< [g][node] dN/dx
    F log_h[8][8][3];  ///< h times w0 mu Jd: the term of -mu Jd ln J
    F metric[8][6];    ///< G of each integration point
    F volume_gradient[8][3];
    F pressure;          ///< times the geometric factor
    F volume_stiffness;  ///< kappa / (V Jd)
    F now[8][3];  ///< positions relative to the first node: keeps digits of the second derivative of volume
};

template <int L>
inline void tangent_data(const ElementArrays& e, const double* displacement, int quad, double geometric,
                         TangentData<L>& t) {
    using D = typename LaneTypes<L>::D;
    using F = typename LaneTypes<L>::F;
    const Nodes<L> nodes(e, displacement, quad);
    const D mu = *reinterpret_cast<const D*>(e.shear + quad * e.moduli_stride);
    const D kappa = *reinterpret_cast<const D*>(e.bulk + quad * e.moduli_stride);
    const D* dehydration =
        reinterpret_cast<const D*>(e.dehydration + static_cast<std::int64_t>(quad) * 7 * L);
    const D jd = dehydration[0];
    const D mu_jd = mu * jd;
    D rest_volume = mu - mu;
    D volume = mu - mu;
    F weight[8];
    for (int g = 0; g < 8; ++g) {
        D j0[9];
        D j1[9];
        D metric[6];
        D cof[9];
        jacobian(nodes.rest, g, j0);
        jacobian(nodes.now, g, j1);
        const D w0 = fresh_metric(j0, dehydration + 1, metric);
        const D w1 = cofactor_matrix(j1, cof);
        rest_volume += w0;
        volume += w1;
        weight[g] = __builtin_convertvector(w1, F);
        for (int i = 0; i < 6; ++i) t.metric[g][i] = __builtin_convertvector(metric[i] * mu_jd, F);
        const D inv_w1 = 1.0 / w1;
        const F log_weight = __builtin_convertvector(w0 * mu_jd * geometric, F);
        F inverse[9];
        for (int i = 0; i < 9; ++i) inverse[i] = __builtin_convertvector(cof[i] * inv_w1, F);
        for (int a = 0; a < 8; ++a)
            for (int i = 0; i < 3; ++i) {
                const F h = inverse[3 * i] * static_cast<float>(kShape.d[g][a][0]) +
                            inverse[3 * i + 1] * static_cast<float>(kShape.d[g][a][1]) +
                            inverse[3 * i + 2] * static_cast<float>(kShape.d[g][a][2]);
                t.h[g][a][i] = h;
                t.log_h[g][a][i] = h * log_weight;
            }
    }
    const D rest_dried = rest_volume * jd;
    t.pressure = __builtin_convertvector(kappa * (volume / rest_dried - 1.0) * geometric, F);
    t.volume_stiffness = __builtin_convertvector(kappa / rest_dried, F);
    for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) {
            F sum = weight[0] * t.h[0][a][i];
            for (int g = 1; g < 8; ++g) sum += weight[g] * t.h[g][a][i];
            t.volume_gradient[a][i] = sum;
            t.now[a][i] = __builtin_convertvector(nodes.now[a][i] - nodes.now[0][i], F);
        }
}

/// Products of shape derivatives that the isotropic term needs, for every pair of nodes: [a][b][g][6].
struct DerivativeProducts {
    float p[8][8][8][6];
    constexpr DerivativeProducts() : p{} {
        for (int a = 0; a < 8; ++a)
            for (int b = 0; b < 8; ++b)
                for (int g = 0; g < 8; ++g) {
                    const double* x = kShape.d[g][a];
                    const double* y = kShape.d[g][b];
                    float* out = p[a][b][g];
                    out[0] = static_cast<float>(x[0] * y[0]);
                    out[1] = static_cast<float>(x[0] * y[1] + x[1] * y[0]);
                    out[2] = static_cast<float>(x[0] * y[2] + x[2] * y[0]);
                    out[3] = static_cast<float>(x[1] * y[1]);
                    out[4] = static_cast<float>(x[1] * y[2] + x[2] * y[1]);
                    out[5] = static_cast<float>(x[2] * y[2]);
                }
    }
};

static constexpr DerivativeProducts kProducts;

/// block[3 i + j] = d2W / dx_ai dx_bj. Terms: tr(J1 G J1^T)/2 gives (D_a . G D_b) on the diagonal; -mu Jd ln
/// J gives h_aj h_bi; the mean dilatation gives V_a V_b kappa / (V Jd) and p d2V/dx_ai dx_bj = p eps_ijk
/// sum_c T_abc x_ck.
template <int L>
inline void tangent_block(const TangentData<L>& t, int a, int b, typename LaneTypes<L>::F block[9]) {
    using F = typename LaneTypes<L>::F;
    F isotropic = t.metric[0][0] * kProducts.p[a][b][0][0];
    F m[9];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[3 * i + j] = t.log_h[0][a][j] * t.h[0][b][i];
    for (int entry = 1; entry < 6; ++entry) isotropic += t.metric[0][entry] * kProducts.p[a][b][0][entry];
    for (int g = 1; g < 8; ++g) {
        for (int entry = 0; entry < 6; ++entry) isotropic += t.metric[g][entry] * kProducts.p[a][b][g][entry];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m[3 * i + j] += t.log_h[g][a][j] * t.h[g][b][i];
    }
    F w[3];
    for (int k = 0; k < 3; ++k) {
        w[k] = t.now[1][k] * kShape.triple[a][b][1];
        for (int c = 2; c < 8; ++c) w[k] += t.now[c][k] * kShape.triple[a][b][c];
        w[k] *= t.pressure;
    }
    for (int i = 0; i < 3; ++i) {
        const F scaled = t.volume_stiffness * t.volume_gradient[a][i];
        for (int j = 0; j < 3; ++j) block[3 * i + j] = m[3 * i + j] + scaled * t.volume_gradient[b][j];
        block[4 * i] += isotropic;
    }
    block[1] += w[2];
    block[2] -= w[1];
    block[3] -= w[2];
    block[5] += w[0];
    block[6] += w[1];
    block[7] -= w[0];
}

template <int L>
void assemble(const ElementArrays& e, const double* displacement, const std::int32_t (*pair_entry)[6],
              TangentFactors factors, MatrixArrays matrix, Range quads) {
    TangentData<L> t;
    for (int quad = quads.begin; quad < quads.end; ++quad) {
        tangent_data<L>(e, displacement, quad, factors.geometric, t);
        add_blocks<L>(e.quads[quad], pair_entry[quad], matrix,
                      [&t](int a, int b, LaneFloats<L>* block) { tangent_block<L>(t, a, b, block); });
    }
}
