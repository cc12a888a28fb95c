// Transposition of 16 x 16 floats. Included inside the namespace of one instruction set (see lanes.h).

/// Lane k of the first (second) result of a stage of the transposition, as an index into both operands.
constexpr int first_index(int bit, int k) { return (k & bit) == 0 ? k : 16 + (k ^ bit); }
constexpr int second_index(int bit, int k) { return (k & bit) == 0 ? k | bit : 16 + k; }

template <int b>
inline void transpose_stage(LaneTypes<16>::F rows[16]) {
    for (int i = 0; i < 16; ++i) {
        if ((i & b) != 0) continue;
        const LaneTypes<16>::F x = rows[i];
        const LaneTypes<16>::F y = rows[i | b];
        rows[i] = __builtin_shufflevector(
            x, y, first_index(b, 0), first_index(b, 1), first_index(b, 2), first_index(b, 3),
            first_index(b, 4), first_index(b, 5), first_index(b, 6), first_index(b, 7), first_index(b, 8),
            first_index(b, 9), first_index(b, 10), first_index(b, 11), first_index(b, 12), first_index(b, 13),
            first_index(b, 14), first_index(b, 15));
        rows[i | b] = __builtin_shufflevector(
            x, y, second_index(b, 0), second_index(b, 1), second_index(b, 2), second_index(b, 3),
            second_index(b, 4), second_index(b, 5), second_index(b, 6), second_index(b, 7),
            second_index(b, 8), second_index(b, 9), second_index(b, 10), second_index(b, 11),
            second_index(b, 12), second_index(b, 13), second_index(b, 14), second_index(b, 15));
    }
}

/// Transposes 16 x 16 floats.
inline void transpose(LaneTypes<16>::F rows[16]) {
    transpose_stage<1>(rows);
    transpose_stage<2>(rows);
    transpose_stage<4>(rows);
    transpose_stage<8>(rows);
}
