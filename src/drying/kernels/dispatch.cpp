#include "drying/kernels/kernels.h"

namespace windfall::drying {

namespace avx2 {
extern const KernelTable kTable8, kTable16;
}
namespace avx512 {
extern const KernelTable kTable8, kTable16;
}

namespace {

bool machine_has_avx512() {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
           __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
}

}  // namespace

const KernelTable& kernels(int layers) {
    static const bool kHasAvx512 = machine_has_avx512();
    if (!kHasAvx512) return kernels_avx2(layers);
    return layers == 16 ? avx512::kTable16 : avx512::kTable8;
}

const KernelTable& kernels_avx2(int layers) { return layers == 16 ? avx2::kTable16 : avx2::kTable8; }

}  // namespace windfall::drying
