#pragma once
/// The choice of the instruction set that kernels are run with.

#include <vector>

namespace gambeson {

/// Those of a kernel's three copies (for AVX-512, AVX2 and SSE2) that this machine runs, widest first.
template <class Kernel>
std::vector<const Kernel*> runnable(const Kernel& avx512, const Kernel& avx2, const Kernel& sse2) {
  std::vector<const Kernel*> sets;
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    sets.push_back(&avx512);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back(&avx2);
  sets.push_back(&sse2);
  return sets;
}

}  // namespace gambeson
