#include "core/step/kernels.h"

namespace pastefit {

std::vector<const KernelTable*> kernels_this_processor_runs() {
  __builtin_cpu_init();
  std::vector<const KernelTable*> tables{&sse2::kernels};
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return tables;
  tables.insert(tables.begin(), &avx2::kernels);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    tables.insert(tables.begin(), &avx512::kernels);
  return tables;
}

const KernelTable& kernels_of_this_processor() {
  static const KernelTable& widest = *kernels_this_processor_runs().front();
  return widest;
}

double total(std::span<const EnergySums> shares, EnergySums::Kind kind) {
  double sum = 0;
  for (const EnergySums& share : shares)
    for (const double value : share.lane[kind]) sum += value;
  return sum;
}

}  // namespace pastefit
