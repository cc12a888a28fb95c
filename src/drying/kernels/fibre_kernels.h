// Energy, gradient and Hessian of fibres in the hexahedra (fibres.h has the law). Included after
// element_kernels.h inside the namespace of one instruction set (see lanes.h). A pass of its own, so that
// fruit without fibres runs the code that it always ran.
//
// Per element, at the integration points g of element_kernels.h, with p the direction of the fibres in the
// fresh fruit over their length without stress, q = J0^-1 p and v = J1 q = F p, whose square is I4:
//   W = sum_g w0 E / 8 (v.v - 1)^2
//   dW/dx_a = sum_g w0 E / 2 (v.v - 1) s_a v,  s_a = D_a . q
//   d2W/dx_a dx_b = sum_g s_a s_b w0 E / 2 [(v.v - 1) I + 2 v v^T]

/// Fibres of one quad's column of elements at an integration point.
template <int L>
struct FibreAtPoint {
    using D = typename LaneTypes<L>::D;
    D weight;  ///< w0 E / 2
    D q[3];
    D v[3];
    D excess;  ///< I4 - 1

    /// `fibres`: p and E of the quad (see FibreArrays).
    FibreAtPoint(const Nodes<L>& nodes, const D* fibres, int g) {
        D j0[9];
        D j1[9];
        D cof[9];
        jacobian(nodes.rest, g, j0);
        jacobian(nodes.now, g, j1);
        const D w0 = cofactor_matrix(j0, cof);
        const D inv_w0 = 1.0 / w0;
        for (int i = 0; i < 3; ++i)
            q[i] = (cof[i] * fibres[0] + cof[3 + i] * fibres[1] + cof[6 + i] * fibres[2]) * inv_w0;
        for (int i = 0; i < 3; ++i) v[i] = j1[3 * i] * q[0] + j1[3 * i + 1] * q[1] + j1[3 * i + 2] * q[2];
        excess = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1.0;
        weight = 0.5 * fibres[3] * w0;
    }

    /// s of a node.
    D along(int g, int node) const {
        return q[0] * kShape.d[g][node][0] + q[1] * kShape.d[g][node][1] + q[2] * kShape.d[g][node][2];
    }
};

template <int L, bool with_force>
inline double fibre_energy_of_quads(const ElementArrays& e, FibreArrays fibres, const double* displacement,
                                    double* force, Range quads) {
    using D = typename LaneTypes<L>::D;
    const D zero = D{};
    D energy = zero;
    for (int quad = quads.begin; quad < quads.end; ++quad) {
        const Nodes<L> nodes(e, displacement, quad);
        const D* own =
            reinterpret_cast<const D*>(fibres.relaxed + static_cast<std::int64_t>(quad) * kFibreEntries * L);
        D result[8][3];
        for (int a = 0; a < 8; ++a)
            for (int i = 0; i < 3; ++i) result[a][i] = zero;
        for (int g = 0; g < 8; ++g) {
            const FibreAtPoint<L> at(nodes, own, g);
            energy += 0.25 * at.weight * at.excess * at.excess;
            if constexpr (with_force) {
                const D tension = at.weight * at.excess;
                for (int a = 0; a < 8; ++a) {
                    const D s = tension * at.along(g, a);
                    for (int i = 0; i < 3; ++i) result[a][i] += s * at.v[i];
                }
            }
        }
        if constexpr (with_force) {
            for (int c = 0; c < 4; ++c)
                for (int i = 0; i < 3; ++i) {
                    D* f = reinterpret_cast<D*>(force +
                                                (3 * static_cast<std::int64_t>(e.quads[quad][c]) + i) * L);
                    *f += result[4 + c][i] + shift_down(result[c][i]);
                }
        }
    }
    return sum_of_lanes(energy);
}

template <int L>
double fibre_energy(const ElementArrays& e, FibreArrays fibres, const double* displacement, double* force,
                    Range quads) {
    return force != nullptr ? fibre_energy_of_quads<L, true>(e, fibres, displacement, force, quads)
                            : fibre_energy_of_quads<L, false>(e, fibres, displacement, nullptr, quads);
}

/// What the blocks of one column of elements are computed from, in single precision.
template <int L>
struct FibreTangent {
    using F = typename LaneTypes<L>::F;
    F along[8][8];      ///< [g][node] s
    F stiffness[8][6];  ///< w0 E / 2 [(I4 - 1) I + 2 v v^T] as xx, xy, xz, yy, yz, zz
};

template <int L>
inline void fibre_tangent(const ElementArrays& e, FibreArrays fibres, const double* displacement, int quad,
                          double geometric, FibreTangent<L>& t) {
    using D = typename LaneTypes<L>::D;
    using F = typename LaneTypes<L>::F;
    const Nodes<L> nodes(e, displacement, quad);
    const D* own =
        reinterpret_cast<const D*>(fibres.relaxed + static_cast<std::int64_t>(quad) * kFibreEntries * L);
    for (int g = 0; g < 8; ++g) {
        const FibreAtPoint<L> at(nodes, own, g);
        const D stress = geometric * at.weight * at.excess;
        const D twice = 2.0 * at.weight;
        int entry = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) {
                D h = twice * at.v[i] * at.v[j];
                if (i == j) h += stress;
                t.stiffness[g][entry++] = __builtin_convertvector(h, F);
            }
        for (int a = 0; a < 8; ++a) t.along[g][a] = __builtin_convertvector(at.along(g, a), F);
    }
}

/// block[3 i + j] = d2W / dx_ai dx_bj
template <int L>
inline void fibre_block(const FibreTangent<L>& t, int a, int b, typename LaneTypes<L>::F block[9]) {
    using F = typename LaneTypes<L>::F;
    F sum[6];
    const F first = t.along[0][a] * t.along[0][b];
    for (int entry = 0; entry < 6; ++entry) sum[entry] = first * t.stiffness[0][entry];
    for (int g = 1; g < 8; ++g) {
        const F both = t.along[g][a] * t.along[g][b];
        for (int entry = 0; entry < 6; ++entry) sum[entry] += both * t.stiffness[g][entry];
    }
    block[0] = sum[0];
    block[1] = block[3] = sum[1];
    block[2] = block[6] = sum[2];
    block[4] = sum[3];
    block[5] = block[7] = sum[4];
    block[8] = sum[5];
}

template <int L>
void assemble_fibres(const ElementArrays& e, FibreArrays fibres, const double* displacement,
                     const std::int32_t (*pair_entry)[6], TangentFactors factors, MatrixArrays matrix,
                     Range quads) {
    FibreTangent<L> t;
    for (int quad = quads.begin; quad < quads.end; ++quad) {
        fibre_tangent<L>(e, fibres, displacement, quad, factors.geometric, t);
        add_blocks<L>(e.quads[quad], pair_entry[quad], matrix,
                      [&t](int a, int b, LaneFloats<L>* block) { fibre_block<L>(t, a, b, block); });
    }
}
