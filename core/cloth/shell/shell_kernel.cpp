#include "core/cloth/shell/shell_kernel.hpp"

#include "core/math/instruction_sets.hpp"

namespace gambeson {

extern const KernelSet kKernels_sse2, kKernels_avx2, kKernels_avx512;

std::span<const KernelSet* const> availableKernels() {
  static const std::vector<const KernelSet*> sets = runnable(kKernels_avx512, kKernels_avx2, kKernels_sse2);
  return sets;
}

const KernelSet& widestKernels() { return *availableKernels().front(); }

}  // namespace gambeson
