#include "core/motion/stitch.hpp"

#include <algorithm>

#include "core/motion/step_contact.hpp"

namespace gambeson {

void addStitchForces(std::span<const Stitch> stitches, const SparseRows& WT, std::span<const Vec3> p,
                     std::span<Vec3> force) {
  for (const Stitch& s : stitches) {
    const Vec3 f = s.stiffness_N_per_m * (sampleAt(WT, s.b, p) - sampleAt(WT, s.a, p));
    for (int k = WT.offsets[s.a]; k < WT.offsets[s.a + 1]; ++k) force[WT.columns[k]] += WT.values[k] * f;
    for (int k = WT.offsets[s.b]; k < WT.offsets[s.b + 1]; ++k) force[WT.columns[k]] -= WT.values[k] * f;
  }
}

void addStitchDamping(std::span<const Stitch> stitches, const SparseRows& WT, std::span<double> drag_kg_per_s) {
  for (const Stitch& s : stitches)
    for (int sample : {s.a, s.b})
      for (int k = WT.offsets[sample]; k < WT.offsets[sample + 1]; ++k)
        drag_kg_per_s[WT.columns[k]] += s.damping_kg_per_s * WT.values[k];
}

double stitchEnergy(std::span<const Stitch> stitches, const SparseRows& WT, std::span<const Vec3> p) {
  double e = 0;
  for (const Stitch& s : stitches) e += 0.5 * s.stiffness_N_per_m * norm2(sampleAt(WT, s.b, p) - sampleAt(WT, s.a, p));
  return e;
}

double widestStitch(std::span<const Stitch> stitches, const SparseRows& WT, std::span<const Vec3> p) {
  double widest = 0;
  for (const Stitch& s : stitches) widest = std::max(widest, norm(sampleAt(WT, s.b, p) - sampleAt(WT, s.a, p)));
  return widest;
}

}  // namespace gambeson
