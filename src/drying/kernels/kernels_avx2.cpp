// The kernels built for AVX2. No header with inline functions of the standard library may be included here:
// the linker could keep this build's copy for the whole program.
#include <immintrin.h>

#include "drying/kernels/kernels.h"

namespace windfall::drying::avx2 {

// The order is that of dependence.
// clang-format off
#include "drying/kernels/lanes.h"
#include "drying/kernels/add_blocks.h"
#include "drying/kernels/element_kernels.h"
#include "drying/kernels/fibre_kernels.h"
#include "drying/kernels/volume_kernels.h"
#include "drying/kernels/transpose.h"
#include "drying/kernels/column_inverse.h"
#include "drying/kernels/column_kernels.h"
#include "drying/kernels/galerkin.h"
#include "drying/kernels/table.h"
// clang-format on

extern const KernelTable kTable8 = make_table<8>("AVX2");
extern const KernelTable kTable16 = make_table<16>("AVX2");

}  // namespace windfall::drying::avx2
