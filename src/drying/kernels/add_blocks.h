// Where the blocks of one quad's column of elements stand in the matrix. Included inside the namespace of one
// instruction set (see lanes.h).

/// Adds the blocks of the eight nodes' pairs to the matrix; `block_of(a, b, block)` computes one: [3 i + j]
/// is the derivative of the force on node a along i with respect to node b along j.
template <int L, class BlockOf>
inline void add_blocks(const std::int32_t quad[4], const std::int32_t pair_entry[6], MatrixArrays matrix,
                       BlockOf block_of) {
    using F = typename LaneTypes<L>::F;
    static const int kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    F k[9];
    for (int c = 0; c < 4; ++c) {
        F* out = reinterpret_cast<F*>(matrix.diagonal + static_cast<std::int64_t>(quad[c]) * 18 * L);
        block_of(4 + c, c, k);
        for (int i = 0; i < 9; ++i) {
            k[i][0] = 0;  // the node below the first layer is on the stone
            out[i] += k[i];
        }
        block_of(4 + c, 4 + c, k);
        for (int i = 0; i < 9; ++i) out[9 + i] += k[i];
        block_of(c, c, k);
        for (int i = 0; i < 9; ++i) out[9 + i] += shift_down(k[i]);
    }
    for (int pair = 0; pair < 6; ++pair) {
        int row = kPairs[pair][0];
        int other = kPairs[pair][1];
        if (quad[row] < quad[other]) {
            const int swap = row;
            row = other;
            other = swap;
        }
        F* out = reinterpret_cast<F*>(matrix.lower + static_cast<std::int64_t>(pair_entry[pair]) * 27 * L);
        block_of(4 + row, other, k);
        for (int i = 0; i < 9; ++i) {
            k[i][0] = 0;
            out[i] += k[i];
        }
        block_of(4 + row, 4 + other, k);
        for (int i = 0; i < 9; ++i) out[9 + i] += k[i];
        block_of(row, other, k);
        for (int i = 0; i < 9; ++i) out[9 + i] += shift_down(k[i]);
        block_of(row, 4 + other, k);
        for (int i = 0; i < 9; ++i) out[18 + i] += shift_down(k[i]);
    }
}
