#include "core/step/kernels.h"

#include <algorithm>

#include "core/target.h"

namespace pastefit {

namespace {

const KernelTable*& chosen_kernels() {
  static const KernelTable* chosen = kernels_this_processor_runs().front();
  return chosen;
}

/// "avx512" for AVX-512: as words in files and on command lines are written.
std::string plain_name(const KernelTable& kernels) {
  std::string name;
  for (const char letter : kernels.instruction_set)
    if (letter != '-') name += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  return name;
}

}  // namespace

std::vector<const KernelTable*> kernels_this_processor_runs() {
  std::vector<const KernelTable*> tables{&four_lanes::kernels};
#if PASTEFIT_X86
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return tables;
  tables.insert(tables.begin(), &avx2::kernels);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    tables.insert(tables.begin(), &avx512::kernels);
#endif
  return tables;
}

const KernelTable& kernels_of_this_processor() {
  return *chosen_kernels();
}

bool use_kernels(std::string_view instruction_set) {
  const auto tables = kernels_this_processor_runs();
  const auto named = std::ranges::find(tables, instruction_set, [](const auto* table) { return plain_name(*table); });
  if (named == tables.end()) return false;
  chosen_kernels() = *named;
  return true;
}

std::string usable_kernels() {
  std::string names;
  for (const KernelTable* table : kernels_this_processor_runs())
    names += (names.empty() ? "" : ", ") + plain_name(*table);
  return names;
}

double total(std::span<const EnergySums> shares, EnergySums::Kind kind) {
  double sum = 0;
  for (const EnergySums& share : shares)
    for (const double value : share.lane[kind]) sum += value;
  return sum;
}

}  // namespace pastefit
