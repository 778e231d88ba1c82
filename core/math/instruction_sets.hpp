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

/// The name of the widest that this machine runs: bits of results are the same on machines of the same.
inline const char* widestInstructionSet() {
  static constexpr const char* avx512 = "avx512";
  static constexpr const char* avx2 = "avx2";
  static constexpr const char* sse2 = "sse2";
  return *runnable(avx512, avx2, sse2).front();
}

/// What kernels call themselves that are compiled once, for all machines alike.
inline constexpr const char* kOneForAll = "scalar";

}  // namespace gambeson
