// Products, smoothing and transfer over columns. Included inside the namespace of one instruction set (see
// lanes.h).

/// r -= block * x, for a block of 27 vectors given by `at(i)`.
template <class V, class Block>
inline void subtract_block(Block at, const V* x, V r[3]) {
    const V same[3] = {x[0], x[1], x[2]};
    const V below[3] = {shift_up(same[0]), shift_up(same[1]), shift_up(same[2])};
    const V above[3] = {shift_down(same[0]), shift_down(same[1]), shift_down(same[2])};
    for (int i = 0; i < 3; ++i) {
        // Three sums side by side: one alone would wait for each addition to finish.
        const V from_below = at(3 * i) * below[0] + at(3 * i + 1) * below[1] + at(3 * i + 2) * below[2];
        const V from_same = at(9 + 3 * i) * same[0] + at(10 + 3 * i) * same[1] + at(11 + 3 * i) * same[2];
        const V from_above =
            at(18 + 3 * i) * above[0] + at(19 + 3 * i) * above[1] + at(20 + 3 * i) * above[2];
        r[i] -= (from_below + from_same) + from_above;
    }
}

/// y -= block^T * x
template <class V, class Block>
inline void subtract_transposed_block(Block at, const V x[3], V* y) {
    for (int j = 0; j < 3; ++j) {
        const V below = at(j) * x[0] + at(3 + j) * x[1] + at(6 + j) * x[2];
        const V same = at(9 + j) * x[0] + at(12 + j) * x[1] + at(15 + j) * x[2];
        const V above = at(18 + j) * x[0] + at(21 + j) * x[1] + at(24 + j) * x[2];
        y[j] -= same + shift_down(below) + shift_up(above);
    }
}

/// How far ahead loops ask for what they read, in columns of the smoother and entries of the matrix: left to
/// itself the processor waits for memory half of the time.
constexpr int kPrefetchedColumns = 2;
constexpr int kPrefetchedEntries = 4;

// Always inline: GCC takes a function that only prefetches for one that does nothing, and leaves it out.
__attribute__((always_inline)) inline void prefetch(const void* begin, const void* end) {
    constexpr int kCacheLine = 64;
    for (auto* line = static_cast<const char*>(begin); line < end; line += kCacheLine)
        _mm_prefetch(line, _MM_HINT_T0);
}

template <int L>
double product(const MatrixArrays& m, const float* x, float* y, Range columns) {
    using F = typename LaneTypes<L>::F;
    using D = typename LaneTypes<L>::D;
    D inner = {};
    const std::int64_t last = m.lower_begin[columns.end];
    for (std::int64_t v = columns.begin; v < columns.end; ++v) {
        const F* xv = reinterpret_cast<const F*>(x + 3 * v * L);
        const F minus[3] = {-xv[0], -xv[1], -xv[2]};
        const F* d = reinterpret_cast<const F*>(m.diagonal + v * 18 * L);
        F sum[3];
        for (int i = 0; i < 3; ++i) {
            const F from_above = d[i] * xv[0] + d[3 + i] * xv[1] + d[6 + i] * xv[2];
            sum[i] = d[9 + 3 * i] * xv[0] + d[10 + 3 * i] * xv[1] + d[11 + 3 * i] * xv[2] +
                     shift_down(from_above) + d[3 * i] * shift_up(xv[0]) + d[3 * i + 1] * shift_up(xv[1]) +
                     d[3 * i + 2] * shift_up(xv[2]);
        }
        F negative[3] = {-sum[0], -sum[1], -sum[2]};
        for (std::int64_t e = m.lower_begin[v]; e < m.lower_begin[v + 1]; ++e) {
            const F* block = reinterpret_cast<const F*>(m.lower + e * 27 * L);
            if (e + kPrefetchedEntries < last)
                prefetch(block + 27 * kPrefetchedEntries, block + 27 * (kPrefetchedEntries + 1));
            const auto at = [block](int i) { return block[i]; };
            const std::int64_t w = m.lower_column[e];
            subtract_block(at, reinterpret_cast<const F*>(x + 3 * w * L), negative);
            subtract_transposed_block(at, minus, reinterpret_cast<F*>(y + 3 * w * L));
        }
        F* yv = reinterpret_cast<F*>(y + 3 * v * L);
        for (int i = 0; i < 3; ++i) yv[i] = -negative[i];
        // The lower blocks stand for the upper ones too, the diagonal for itself.
        inner += __builtin_convertvector(minus[0] * (2 * negative[0] + sum[0]) +
                                             minus[1] * (2 * negative[1] + sum[1]) +
                                             minus[2] * (2 * negative[2] + sum[2]),
                                         D);
    }
    return sum_of_lanes(inner);
}

/// Offset of a column's inverse in SmootherArrays::packed; its lower blocks follow.
template <int L>
inline std::int64_t packed_offset(const MatrixArrays& m, std::int64_t column) {
    return (inverse_vectors(L) * column + 27 * static_cast<std::int64_t>(m.lower_begin[column])) * L;
}

template <int L>
bool pack_inverses(const MatrixArrays& m, SmootherArrays s, Range columns) {
    using Batch = LaneTypes<16>::F;
    for (std::int64_t first = columns.begin; first < columns.end; first += 16) {
        Batch3x3 own[L];
        Batch3x3 below[L];
        load_columns<L>(m, first, columns.end - 1, own, below);
        BatchInverse<L> inverse;
        if (!inverse.invert(own, below)) return false;
        const int count = columns.end - first < 16 ? static_cast<int>(columns.end - first) : 16;
        float root[16];
        for (int q = 0; q < count; ++q) {
            root[q] = half_scale_root(inverse.largest[q]);
            s.inverse_factor[first + q] = 1 / (root[q] * root[q] * s.matrix_scale);
        }
        Batch* rows = &inverse.at[0][0];
        for (int i = 0; i < inverse_vectors(L) * L; i += 16) {
            transpose(rows + i);
            const bool pairs = i < 18 * L;
            for (int q = 0; q < count; ++q)
                store_half<16>(s.packed + packed_offset<L>(m, first + q) + i,
                               rows[i + q] * (pairs ? root[q] * root[q] : root[q]));
        }
    }
    return true;
}

template <int L>
void pack_lower(const MatrixArrays& m, SmootherArrays s, Range columns) {
    using F = typename LaneTypes<L>::F;
    for (std::int64_t v = columns.begin; v < columns.end; ++v) {
        std::uint16_t* out = s.packed + packed_offset<L>(m, v) + inverse_vectors(L) * L;
        const F* lower =
            reinterpret_cast<const F*>(m.lower + static_cast<std::int64_t>(m.lower_begin[v]) * 27 * L);
        const int count = 27 * (m.lower_begin[v + 1] - m.lower_begin[v]);
        for (int i = 0; i < count; ++i, out += L) store_half<L>(out, lower[i] * s.matrix_scale);
    }
}

/// Asks for the smoother of a column that a sweep comes to soon.
template <int L>
__attribute__((always_inline)) inline void prefetch_column(const MatrixArrays& m, const SmootherArrays& s,
                                                           std::int64_t v) {
    prefetch(s.packed + packed_offset<L>(m, v), s.packed + packed_offset<L>(m, v + 1));
}

/// One column of a Gauss-Seidel sweep: solves its block for the right-hand side r (times matrix_scale) less
/// the lower blocks, stores x, and takes what x adds to the rows of the lower columns off `residual`.
template <int L>
inline void sweep_column(const MatrixArrays& m, const SmootherArrays& s, std::int64_t v,
                         typename LaneTypes<L>::F r[3], float* x, float* residual) {
    using F = typename LaneTypes<L>::F;
    const std::uint16_t* inverse = s.packed + packed_offset<L>(m, v);
    const std::uint16_t* blocks = inverse + inverse_vectors(L) * L;
    const int begin = m.lower_begin[v];
    const int end = m.lower_begin[v + 1];
    for (int e = begin; e < end; ++e) {
        const std::uint16_t* block = blocks + (e - begin) * 27 * L;
        subtract_block([block](int i) { return load_half<L>(block + i * L); },
                       reinterpret_cast<const F*>(x + 3 * static_cast<std::int64_t>(m.lower_column[e]) * L),
                       r);
    }
    F solved[3];
    apply_inverse<L>(inverse, s.inverse_factor[v], r, solved);
    F* xv = reinterpret_cast<F*>(x + 3 * v * L);
    for (int i = 0; i < 3; ++i) xv[i] = solved[i];
    for (int e = begin; e < end; ++e) {
        const std::uint16_t* block = blocks + (e - begin) * 27 * L;
        subtract_transposed_block(
            [block](int i) { return load_half<L>(block + i * L); }, solved,
            reinterpret_cast<F*>(residual + 3 * static_cast<std::int64_t>(m.lower_column[e]) * L));
    }
}

template <int L>
void sweep_forward(const MatrixArrays& m, const SmootherArrays& s, const float* b, float* x, float* residual,
                   Range columns) {
    using F = typename LaneTypes<L>::F;
    for (std::int64_t v = columns.begin; v < columns.end; ++v) {
        const F* bv = reinterpret_cast<const F*>(b + 3 * v * L);
        F* own = reinterpret_cast<F*>(residual + 3 * v * L);
        F r[3];
        for (int i = 0; i < 3; ++i) {
            r[i] = bv[i] * s.matrix_scale;
            own[i] = r[i] - r[i];
        }
        if (v + kPrefetchedColumns < columns.end) prefetch_column<L>(m, s, v + kPrefetchedColumns);
        sweep_column<L>(m, s, v, r, x, residual);
    }
}

template <int L>
void sweep_backward(const MatrixArrays& m, const SmootherArrays& s, const float* b, float* x, float* residual,
                    Range columns) {
    using F = typename LaneTypes<L>::F;
    for (std::int64_t v = static_cast<std::int64_t>(columns.end) - 1; v >= columns.begin; --v) {
        const F* bv = reinterpret_cast<const F*>(b + 3 * v * L);
        const F* own = reinterpret_cast<const F*>(residual + 3 * v * L);
        F r[3];
        for (int i = 0; i < 3; ++i) r[i] = bv[i] * s.matrix_scale + own[i];
        if (v - kPrefetchedColumns >= columns.begin) prefetch_column<L>(m, s, v - kPrefetchedColumns);
        sweep_column<L>(m, s, v, r, x, residual);
    }
}

template <int L>
void restrict_residual(const TransferArrays& t, float inverse_matrix_scale, const float* residual,
                       float* coarse_b, Range coarse_columns) {
    using F = typename LaneTypes<L>::F;
    for (std::int64_t v = coarse_columns.begin; v < coarse_columns.end; ++v) {
        F sum[3] = {};
        for (int c = t.child_begin[v]; c < t.child_begin[v + 1]; ++c) {
            const float weight = t.child_weight[c] * inverse_matrix_scale;
            const F* r =
                reinterpret_cast<const F*>(residual + 3 * static_cast<std::int64_t>(t.child_column[c]) * L);
            for (int i = 0; i < 3; ++i) sum[i] += weight * r[i];
        }
        F* out = reinterpret_cast<F*>(coarse_b + 3 * v * L);
        for (int i = 0; i < 3; ++i) out[i] = sum[i];
    }
}

template <int L>
void prolong(const TransferArrays& t, const float* coarse_x, float* x, float* residual, Range columns) {
    using F = typename LaneTypes<L>::F;
    for (std::int64_t v = columns.begin; v < columns.end; ++v) {
        F* xv = reinterpret_cast<F*>(x + 3 * v * L);
        F* rv = reinterpret_cast<F*>(residual + 3 * v * L);
        const float weight = 1.0F / static_cast<float>(t.parent_count[v]);
        for (int i = 0; i < 3; ++i) {
            F sum = {};
            for (int p = 0; p < t.parent_count[v]; ++p)
                sum += reinterpret_cast<const F*>(coarse_x +
                                                  3 * static_cast<std::int64_t>(t.parent[v][p]) * L)[i];
            xv[i] += weight * sum;
            rv[i] = sum - sum;
        }
    }
}
