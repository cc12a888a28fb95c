// The table of one instruction set. Included last inside its namespace (see lanes.h).

template <int L>
constexpr KernelTable make_table(const char* instruction_set) {
    return {instruction_set, energy<L>,          volumes<L>,        assemble<L>,
            fibre_energy<L>, assemble_fibres<L>, product<L>,        pack_inverses<L>,
            pack_lower<L>,   sweep_forward<L>,   sweep_backward<L>, restrict_residual<L>,
            prolong<L>,      galerkin<L>};
}
