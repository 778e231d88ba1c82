#include "core/cloth/triangles/triangle_kernel.hpp"

#include "core/math/instruction_sets.hpp"

namespace gambeson {

extern const TriangleKernels kTriangles_sse2, kTriangles_avx2, kTriangles_avx512;

std::span<const TriangleKernels* const> triangleKernels() {
  static const std::vector<const TriangleKernels*> sets = runnable(kTriangles_avx512, kTriangles_avx2, kTriangles_sse2);
  return sets;
}

}  // namespace gambeson
