#include "core/step/kernels.h"

namespace pastefit {

const KernelTable& kernels_of_this_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("fma"))
    return avx512::kernels;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::kernels;
  return sse2::kernels;
}

double total(std::span<const EnergySums> shares, EnergySums::Kind kind) {
  double sum = 0;
  for (const EnergySums& share : shares)
    for (const double value : share.lane[kind]) sum += value;
  return sum;
}

}  // namespace pastefit
