#include "core/cloth/shell/shell_kernel.hpp"

namespace gambeson {

extern const KernelSet kKernels_sse2, kKernels_avx2, kKernels_avx512;

std::span<const KernelSet* const> availableKernels() {
  static const std::vector<const KernelSet*> sets = [] {
    std::vector<const KernelSet*> s;
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      s.push_back(&kKernels_avx512);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) s.push_back(&kKernels_avx2);
    s.push_back(&kKernels_sse2);
    return s;
  }();
  return sets;
}

const KernelSet& widestKernels() { return *availableKernels().front(); }

}  // namespace gambeson
