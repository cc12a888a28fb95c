// Inverses of columns' own blocks, for the smoother. Included inside the namespace of one instruction set
// (see lanes.h).
//
// A column's block is block tridiagonal over its layers, so its inverse G is semiseparable: blocks of G off
// the diagonal have rank 3 (Meurant 1992, "A review on the inverse of symmetric tridiagonal and block
// tridiagonal matrices", section 3). For layers l <= m <= k, G_lk = G_lm G_mm^-1 G_mk, or W_l W_k^T with
// W_l = G_lm C^-T, where G_mm = C C^T. It is kept so, exactly and in half of the dense inverse's space or
// less: dense for pairs of layers, and for groups of 4, 8 (and 16) layers the factors W that couple the two
// halves of the group, m being the last layer of the first half. (In larger circles: a hierarchically
// semiseparable form; Chandrasekaran, Gu and Pals 2006.)

/// One 3 x 3 matrix of each of 16 columns, row-major.
struct Batch3x3 {
    using Batch = LaneTypes<16>::F;
    Batch at[9];

    Batch& operator()(int i, int j) { return at[3 * i + j]; }
    const Batch& operator()(int i, int j) const { return at[3 * i + j]; }
};

inline Batch3x3 times(const Batch3x3& a, const Batch3x3& b) {
    Batch3x3 c;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
    return c;
}

inline Batch3x3 times_transposed(const Batch3x3& a, const Batch3x3& b) {
    Batch3x3 c;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(j, 0) + a(i, 1) * b(j, 1) + a(i, 2) * b(j, 2);
    return c;
}

/// A = L D L^T of a symmetric matrix, L having a unit diagonal.
struct BatchFactors {
    using Batch = LaneTypes<16>::F;
    Batch l10, l20, l21, d[3];

    explicit BatchFactors(const Batch3x3& a) {
        d[0] = a(0, 0);
        l10 = a(1, 0) / d[0];
        l20 = a(2, 0) / d[0];
        d[1] = a(1, 1) - l10 * a(1, 0);
        const Batch rest = a(2, 1) - l20 * a(1, 0);
        l21 = rest / d[1];
        d[2] = a(2, 2) - l20 * a(2, 0) - l21 * rest;
    }
    bool positive() const {
        for (int i = 0; i < 3; ++i)
            for (int q = 0; q < 16; ++q)
                if (!(d[i][q] > 0)) return false;
        return true;
    }
    Batch3x3 inverse() const {
        const Batch m20 = l21 * l10 - l20;
        const Batch i1 = 1.0F / d[1];
        const Batch i2 = 1.0F / d[2];
        Batch3x3 a;
        a(2, 2) = i2;
        a(1, 2) = a(2, 1) = -l21 * i2;
        a(1, 1) = i1 + l21 * l21 * i2;
        a(0, 2) = a(2, 0) = m20 * i2;
        a(0, 1) = a(1, 0) = -l10 * i1 - m20 * l21 * i2;
        a(0, 0) = 1.0F / d[0] + l10 * l10 * i1 + m20 * m20 * i2;
        return a;
    }
};

/// Square roots of 16 lanes.
inline LaneTypes<16>::F square_roots(LaneTypes<16>::F a) {
    union {
        LaneTypes<16>::F vector;
        __m256 parts[2];
    } u;
    u.vector = a;
    for (__m256& part : u.parts) part = _mm256_sqrt_ps(part);
    return u.vector;
}

/// What the smoother keeps of 16 columns' inverses, [vector][layer]. Vectors: pairs [2 sources][3 of the
/// source][3 of the target], then [group size][3 ranks][3].
template <int L>
struct BatchInverse {
    using Batch = LaneTypes<16>::F;
    Batch at[inverse_vectors(L)][L];
    Batch largest;  ///< on the diagonal of the inverse

    /// `own[k]`: layer k's diagonal block; `below[k]`: its coupling with layer k - 1. False where a column is
    /// not positive definite.
    bool invert(const Batch3x3 own[L], const Batch3x3 below[L]) {
        // Elimination from the stone outwards: G_lk = F_l G_(l+1)k for l < k, F_l = -S_l^-1 E_(l+1)^T.
        Batch3x3 inverse[L];
        Batch3x3 factor[L];
        Batch3x3 pivot = own[0];
        for (int k = 0; k < L; ++k) {
            if (k > 0) {
                const Batch3x3 eliminated = times(below[k], factor[k - 1]);
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        pivot(i, j) = own[k](i, j) + 0.5F * (eliminated(i, j) + eliminated(j, i));
            }
            const BatchFactors factors(pivot);
            if (!factors.positive()) return false;
            inverse[k] = factors.inverse();
            if (k + 1 == L) break;
            factor[k] = times_transposed(inverse[k], below[k + 1]);
            for (Batch& entry : factor[k].at) entry = -entry;
        }
        // And back: G_kk = S_k^-1 + F_k G_(k+1)(k+1) F_k^T, a sum of positive terms.
        Batch3x3 coupling[L];  // G_k(k+1)
        for (int k = L - 2; k >= 0; --k) {
            coupling[k] = times(factor[k], inverse[k + 1]);
            const Batch3x3 added = times_transposed(coupling[k], factor[k]);
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j <= i; ++j) inverse[k](j, i) = inverse[k](i, j) += added(i, j);
        }
        largest = inverse[0](0, 0);
        for (int k = 0; k < L; ++k)
            for (int i = 0; i < 3; ++i) {
                const Batch entry = inverse[k](i, i);
                largest = entry > largest ? entry : largest;
            }
        store_pairs(inverse, coupling);
        bool definite = true;
        for (int size = 4, vector = 18; size <= L; size *= 2, vector += 9)
            for (int begin = 0; begin < L; begin += size)
                definite = store_group(inverse, factor, begin, begin + size, vector) && definite;
        return definite;
    }

  private:
    void store_pairs(const Batch3x3 inverse[L], const Batch3x3 coupling[L]) {
        for (int k = 0; k < L; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i) {
                    const int other = k % 2 == 0 ? 1 : 0;
                    at[((1 - other) * 3 + j) * 3 + i][k] = inverse[k](i, j);
                    at[(other * 3 + j) * 3 + i][k] = other == 1 ? coupling[k](i, j) : coupling[k - 1](j, i);
                }
    }

    /// W of the layers in [begin, end). False where rounding has left a block indefinite.
    bool store_group(const Batch3x3 inverse[L], const Batch3x3 factor[L], int begin, int end, int vector) {
        const int middle = (begin + end) / 2 - 1;
        const BatchFactors f(inverse[middle]);
        if (!f.positive()) return false;
        const Batch root[3] = {square_roots(f.d[0]), square_roots(f.d[1]), square_roots(f.d[2])};
        const Batch zero = root[0] - root[0];
        Batch3x3 w = {{root[0], zero, zero, f.l10 * root[0], root[1], zero, f.l20 * root[0], f.l21 * root[1],
                       root[2]}};  // C
        const auto store = [&](int k) {
            for (int rank = 0; rank < 3; ++rank)
                for (int i = 0; i < 3; ++i) at[vector + 3 * rank + i][k] = w(i, rank);
        };
        store(middle);
        for (int k = middle - 1; k >= begin; --k) {
            w = times(factor[k], w);
            store(k);
        }
        // C^-1 F_m ... F_(k-1), then W_k = G_kk times its transpose.
        Batch3x3 way = {{1.0F / root[0], zero, zero, -f.l10 / root[1], 1.0F / root[1], zero,
                         (f.l21 * f.l10 - f.l20) / root[2], -f.l21 / root[2], 1.0F / root[2]}};
        for (int k = middle + 1; k < end; ++k) {
            way = times(way, factor[k - 1]);
            w = times_transposed(inverse[k], way);
            store(k);
        }
        return true;
    }
};

/// Diagonal blocks of 16 columns from `first` on; beyond `last` the last one again.
template <int L>
inline void load_columns(const MatrixArrays& m, std::int64_t first, std::int64_t last, Batch3x3 own[L],
                         Batch3x3 below[L]) {
    using Batch = LaneTypes<16>::F;
    Batch entry[18 * L];  // [18][L] of 16 columns
    for (int i = 0; i < 18 * L; i += 16) {
        for (int q = 0; q < 16; ++q) {
            const std::int64_t column = first + q < last ? first + q : last;
            entry[i + q] = *reinterpret_cast<const Batch*>(m.diagonal + column * 18 * L + i);
        }
        transpose(entry + i);
    }
    for (int k = 0; k < L; ++k)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                below[k](i, j) = entry[(3 * i + j) * L + k];
                own[k](i, j) = 0.5F * (entry[(9 + 3 * i + j) * L + k] + entry[(9 + 3 * j + i) * L + k]);
            }
}

/// Square root of the largest even power of two that takes positive `largest` to at most 8192: far from half
/// precision's 65504, with room for sums.
inline float half_scale_root(float largest) {
    int exponent = 0;
    __builtin_frexpf(largest, &exponent);
    return __builtin_ldexpf(1.0F, (13 - exponent) >> 1);
}

/// Lane k of the result is lane 2 floor(k / 2) + `p` of `a`.
template <int p, class V>
inline V spread_pair(V a) {
    if constexpr (sizeof(V) / sizeof(a[0]) == 8) {
        return __builtin_shufflevector(a, a, p, p, 2 + p, 2 + p, 4 + p, 4 + p, 6 + p, 6 + p);
    } else {
        return __builtin_shufflevector(a, a, p, p, 2 + p, 2 + p, 4 + p, 4 + p, 6 + p, 6 + p, 8 + p, 8 + p,
                                       10 + p, 10 + p, 12 + p, 12 + p, 14 + p, 14 + p);
    }
}

/// Lane k of the result is lane k xor `b` of `a`.
template <int b, class V>
inline V swap_lanes(V a) {
    if constexpr (sizeof(V) / sizeof(a[0]) == 8) {
        return __builtin_shufflevector(a, a, 0 ^ b, 1 ^ b, 2 ^ b, 3 ^ b, 4 ^ b, 5 ^ b, 6 ^ b, 7 ^ b);
    } else {
        return __builtin_shufflevector(a, a, 0 ^ b, 1 ^ b, 2 ^ b, 3 ^ b, 4 ^ b, 5 ^ b, 6 ^ b, 7 ^ b, 8 ^ b,
                                       9 ^ b, 10 ^ b, 11 ^ b, 12 ^ b, 13 ^ b, 14 ^ b, 15 ^ b);
    }
}

/// x += the coupling of the halves of groups of 2 `half` layers, times r; and of the larger groups.
template <int L, int half>
inline void add_groups(const std::uint16_t* inverse, const typename LaneTypes<L>::F r[3],
                       typename LaneTypes<L>::F x[3]) {
    using F = typename LaneTypes<L>::F;
    if constexpr (half < L) {
        for (int rank = 0; rank < 3; ++rank) {
            F w[3];
            for (int i = 0; i < 3; ++i) w[i] = load_half<L>(inverse + (3 * rank + i) * L);
            F sum = w[0] * r[0] + w[1] * r[1] + w[2] * r[2];
            sum += swap_lanes<1>(sum);
            if constexpr (half > 2) sum += swap_lanes<2>(sum);
            if constexpr (half > 4) sum += swap_lanes<4>(sum);
            sum = swap_lanes<half>(sum);
            for (int i = 0; i < 3; ++i) x[i] += w[i] * sum;
        }
        add_groups<L, 2 * half>(inverse + 9 * L, r, x);
    }
}

/// x = inverse * r * factor
template <int L>
inline void apply_inverse(const std::uint16_t* inverse, float factor, const typename LaneTypes<L>::F r[3],
                          typename LaneTypes<L>::F x[3]) {
    using F = typename LaneTypes<L>::F;
    // Two running sums per component: one alone would wait for each addition to finish.
    F even[3] = {};
    F odd[3] = {};
    for (int j = 0; j < 3; ++j) {
        const F first = spread_pair<0>(r[j]);
        const F second = spread_pair<1>(r[j]);
        for (int i = 0; i < 3; ++i) {
            even[i] += load_half<L>(inverse + (3 * j + i) * L) * first;
            odd[i] += load_half<L>(inverse + (9 + 3 * j + i) * L) * second;
        }
    }
    add_groups<L, 2>(inverse + 18 * L, r, even);
    for (int i = 0; i < 3; ++i) x[i] = (even[i] + odd[i]) * factor;
}
