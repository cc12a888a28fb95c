// Coarse matrices P^T A P. Included inside the namespace of one instruction set (see lanes.h).
//
// A block of the coarse matrix is a sum of blocks of the fine one, each times a weight. The blocks of a
// coarse row are first sorted by the entry that they go to; then each entry is summed nine vectors at a
// time, which registers hold (but those of AVX2 with 16 layers), where adding block by block would read and
// write the entry once for each.

/// The fine blocks that go to one entry of a coarse row.
template <int L>
class CoarseEntry {
    using F = typename LaneTypes<L>::F;

  public:
    /// How a block is kept: as the entry needs it, as its transpose, or as a diagonal block, whose third part
    /// is the transpose of its first.
    enum Kind { Direct, Transposed, Diagonal };

    void add(Kind kind, const float* block, float weight) {
        List& list = m_lists[kind];
        list.term[list.count++] = {block, weight};
    }

    /// Writes the sum: 27 vectors, or the 18 that a diagonal block keeps. Forgets the blocks.
    void finish(float* out, bool diagonal) {
        F* vectors = reinterpret_cast<F*>(out);
        F below[9] = {};
        F same[9] = {};
        F above[9] = {};
        sum(Transposed, 18, below);
        transpose_part(below, [](F x) { return shift_up(x); });
        sum(Direct, 0, below);
        sum(Diagonal, 0, below);
        sum(Transposed, 9, same);
        transpose_part(same, [](F x) { return x; });
        sum(Direct, 9, same);
        sum(Diagonal, 9, same);
        for (int i = 0; i < 9; ++i) {
            vectors[i] = below[i];
            vectors[9 + i] = same[i];
        }
        if (!diagonal) {
            sum(Transposed, 0, above);
            sum(Diagonal, 0, above);
            transpose_part(above, [](F x) { return shift_down(x); });
            sum(Direct, 18, above);
            for (int i = 0; i < 9; ++i) vectors[18 + i] = above[i];
        }
        for (List& list : m_lists) list.count = 0;
    }

  private:
    /// A coarse column has at most 9 children, each with at most 9 blocks in its row; a block goes to an
    /// entry at most once.
    static constexpr int kMostTerms = 81;
    struct Term {
        const float* block;
        float weight;
    };
    struct List {
        int count = 0;
        Term term[kMostTerms];
    };

    /// part += vectors first .. first + 8 of the blocks of a kind, times their weights.
    void sum(Kind kind, int first, F part[9]) const {
        const List& list = m_lists[kind];
        F sums[9];
        for (int i = 0; i < 9; ++i) sums[i] = part[i];
        for (const Term* term = list.term; term != list.term + list.count; ++term) {
            const F* block = reinterpret_cast<const F*>(term->block) + first;
            for (int i = 0; i < 9; ++i) sums[i] += term->weight * block[i];
        }
        for (int i = 0; i < 9; ++i) part[i] = sums[i];
    }

    template <class Shift>
    static void transpose_part(F part[9], const Shift& shift) {
        F turned[9];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) turned[3 * i + j] = shift(part[3 * j + i]);
        for (int i = 0; i < 9; ++i) part[i] = turned[i];
    }

    List m_lists[3];
};

template <int L>
void galerkin(const MatrixArrays& fine, const UpperArrays& upper, const TransferArrays& t,
              MatrixArrays coarse, Range coarse_columns) {
    constexpr int kMostEntries = 9;  // the diagonal and at most 8 neighbours
    CoarseEntry<L> entries[kMostEntries];
    for (std::int64_t v = coarse_columns.begin; v < coarse_columns.end; ++v) {
        const int first = coarse.lower_begin[v];
        const int count = coarse.lower_begin[v + 1] - first;
        const auto add = [&](typename CoarseEntry<L>::Kind kind, const float* block, int fine_column,
                             float child_weight) {
            const float weight = child_weight / static_cast<float>(t.parent_count[fine_column]);
            for (int p = 0; p < t.parent_count[fine_column]; ++p) {
                const int target = t.parent[fine_column][p];
                if (target > v) continue;
                int entry = 0;
                if (target < v)
                    while (coarse.lower_column[first + entry++] != target) {
                    }
                entries[entry].add(kind, block, weight);
            }
        };
        for (int c = t.child_begin[v]; c < t.child_begin[v + 1]; ++c) {
            const std::int64_t child = t.child_column[c];
            const float weight = t.child_weight[c];
            add(CoarseEntry<L>::Diagonal, fine.diagonal + child * 18 * L, static_cast<int>(child), weight);
            // Summing comes later, when all of the row's blocks are known: by then these are near. Blocks
            // above the child are as a rule in another child's row.
            prefetch(fine.lower + static_cast<std::int64_t>(fine.lower_begin[child]) * 27 * L,
                     fine.lower + static_cast<std::int64_t>(fine.lower_begin[child + 1]) * 27 * L);
            for (int e = fine.lower_begin[child]; e < fine.lower_begin[child + 1]; ++e)
                add(CoarseEntry<L>::Direct, fine.lower + static_cast<std::int64_t>(e) * 27 * L,
                    fine.lower_column[e], weight);
            for (int u = upper.upper_begin[child]; u < upper.upper_begin[child + 1]; ++u)
                add(CoarseEntry<L>::Transposed,
                    fine.lower + static_cast<std::int64_t>(upper.upper_entry[u]) * 27 * L,
                    upper.upper_column[u], weight);
        }
        entries[0].finish(coarse.diagonal + v * 18 * L, true);
        for (int e = 0; e < count; ++e)
            entries[1 + e].finish(coarse.lower + static_cast<std::int64_t>(first + e) * 27 * L, false);
    }
}
