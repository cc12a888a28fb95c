#pragma once
// The hot loops of drying, built twice (AVX2 and AVX-512) from the same text and chosen when the program
// starts. The lanes of a SIMD register are the layers of one column of hexahedra, so that no loop gathers or
// scatters within a register. Everything here works on a range of columns or quads; who calls sees to it that
// ranges that run at the same time do not touch the same column (see column_order.h).
//
// L is the number of layers, 8 or 16. Arrays are 128-byte aligned; "[column][3][L]" is row-major, lanes
// fastest.
#include <cstdint>

namespace windfall::drying {

/// Hexahedra of a layered mesh in solver order. Layer k of a column lies between its nodes k and k + 1, node
/// 0 being on the stone; lane k of a column's vector is node k + 1.
struct ElementArrays {
    const std::int32_t (*quads)[4];  ///< columns at the corners, counter-clockwise from outside
    const double* rest;              ///< [column][3][L] fresh positions
    const double* base;              ///< [column][3] positions on the stone, fixed
    const double* shear;             ///< [quad][L] shear modulus mu, or [L] of all quads
    const double* bulk;              ///< [quad][L] bulk modulus kappa, or [L]
    const double* dehydration;       ///< [quad][7][L] det Fd, then Fd^-1 Fd^-T: xx, xy, xz, yy, yz, zz
    std::int64_t moduli_stride = 0;  ///< between the moduli of two quads: L, or 0 where all are alike
};

/// Fibres of the elements, where there are any (see fibres.h).
struct FibreArrays {
    const double* relaxed;  ///< [quad][4][L] direction in the fresh fruit over the length free of stress: x,
                            ///< y, z; Young's modulus times det Fd
};
constexpr std::int64_t kFibreEntries = 4;

/// Numbers of an element in `volumes`: its volume in the fresh fruit and now, the least and the largest det F
/// at its integration points.
constexpr std::int64_t kVolumeEntries = 4;

/// Symmetric block matrix over columns, lower triangle in solver order. A block couples lane k of the row's
/// column with lanes k - 1, k, k + 1 of the other; entry d * 9 + 3 i + j of a block is component (i, j) for
/// lane k + d - 1.
struct MatrixArrays {
    const std::int32_t* lower_begin;   ///< [columns + 1]
    const std::int32_t* lower_column;  ///< [entries] column of the entry, below the row's
    float* diagonal;                   ///< [column][18][L] d = 0 and d = 1; d = 2 is the transpose of d = 0
    float* lower;                      ///< [entry][27][L]
};

/// Columns above the row's: entries of the lower triangle read as their transposes.
struct UpperArrays {
    const std::int32_t* upper_begin;   ///< [columns + 1]
    const std::int32_t* upper_column;  ///< [entries]
    const std::int32_t* upper_entry;   ///< [entries] index into MatrixArrays::lower
};

/// Prolongation between a level and the next coarser one: equal weights 1 / count over a column's parents.
struct TransferArrays {
    const std::int32_t* child_begin;   ///< [coarse columns + 1]
    const std::int32_t* child_column;  ///< fine columns below a coarse one
    const float* child_weight;
    const std::int32_t (*parent)[4];   ///< [fine column] coarse columns
    const std::int32_t* parent_count;  ///< [fine column]
};

/// Matrix of the Gauss-Seidel smoother in half precision: per column, in order, the inverse of its diagonal
/// block (column_inverse.h) and its lower blocks.
struct SmootherArrays {
    std::uint16_t* packed;
    float matrix_scale;     ///< a power of two: lower blocks are stored times it
    float* inverse_factor;  ///< [column] 1 / (scale of the stored inverse, matrix_scale)
};

/// Vectors of half precision that a column's inverse takes: 18 for pairs of layers, 9 more for each of the
/// group sizes 4, 8, ..., `layers`. Static: no build's copy may become that of the whole program.
static constexpr int inverse_vectors(int layers) {
    int vectors = 18;
    for (int size = 4; size <= layers; size *= 2) vectors += 9;
    return vectors;
}

/// Where the energy kernel adds up, per call.
struct EnergySums {
    double energy;
    double smallest_volume_ratio;  ///< min over integration points of det F
};

/// What the Newton matrix is made of besides the state.
struct TangentFactors {
    double geometric;  ///< 1: the exact Hessian; less: stress terms scaled down, towards a definite matrix
};

struct Range {
    std::int32_t begin;
    std::int32_t end;
};

/// One build of the kernels for one number of layers.
struct KernelTable {
    const char* instruction_set;

    /// Energy of the elements of `quads`; with `force` not null adds their gradient to it ([column][3][L]).
    EnergySums (*energy)(const ElementArrays&, const double* displacement, double* force, Range quads);

    /// Volumes of the elements of `quads` into `out`, [quad][kVolumeEntries][L].
    void (*volumes)(const ElementArrays&, const double* displacement, double* out, Range quads);

    /// Adds the elements' second derivatives to the matrix. `pair_entry`: [quad][6] entry of the lower
    /// triangle for the corner pairs (0,1) (0,2) (0,3) (1,2) (1,3) (2,3).
    void (*assemble)(const ElementArrays&, const double* displacement, const std::int32_t (*pair_entry)[6],
                     TangentFactors, MatrixArrays, Range quads);

    /// The same two of the fibres in the elements: energy and second derivatives.
    double (*fibre_energy)(const ElementArrays&, FibreArrays, const double* displacement, double* force,
                           Range quads);
    void (*assemble_fibres)(const ElementArrays&, FibreArrays, const double* displacement,
                            const std::int32_t (*pair_entry)[6], TangentFactors, MatrixArrays, Range quads);

    /// y = A x; returns what the range adds to x y (products in single precision, sums in double). Ranges in
    /// solver order: y of earlier columns must have been set already.
    double (*product)(const MatrixArrays&, const float* x, float* y, Range columns);

    /// Inverts the diagonal blocks into the smoother; `matrix_scale` is set already. False where a block is
    /// not positive definite.
    bool (*pack_inverses)(const MatrixArrays&, SmootherArrays, Range columns);

    /// Packs the lower blocks to half precision.
    void (*pack_lower)(const MatrixArrays&, SmootherArrays, Range columns);

    /// x = forward Gauss-Seidel from zero for A x = b; leaves in `residual` (times matrix_scale) what the
    /// columns above add to the residual of each column.
    void (*sweep_forward)(const MatrixArrays&, const SmootherArrays&, const float* b, float* x,
                          float* residual, Range columns);
    /// Backward Gauss-Seidel from x; `residual` must be zero at the start.
    void (*sweep_backward)(const MatrixArrays&, const SmootherArrays&, const float* b, float* x,
                           float* residual, Range columns);

    /// b of coarse columns = transposed prolongation of `residual / matrix_scale` of the fine level.
    void (*restrict_residual)(const TransferArrays&, float inverse_matrix_scale, const float* residual,
                              float* coarse_b, Range coarse_columns);
    /// x += prolongation of coarse x; residual = 0.
    void (*prolong)(const TransferArrays&, const float* coarse_x, float* x, float* residual, Range columns);

    /// Coarse matrix = P^T A P, for a range of coarse columns.
    void (*galerkin)(const MatrixArrays& fine, const UpperArrays& fine_upper, const TransferArrays&,
                     MatrixArrays coarse, Range coarse_columns);
};

/// The kernels for this machine. `layers` must be 8 or 16.
const KernelTable& kernels(int layers);
/// The AVX2 build, also where AVX-512 exists (for tests).
const KernelTable& kernels_avx2(int layers);

}  // namespace windfall::drying
