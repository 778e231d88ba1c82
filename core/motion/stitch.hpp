#pragma once
/// Springs that pull panels together until they can be sewn (virtual stitching, Zheng 2013, section 6.3).

#include <span>
#include <vector>

#include "core/math/sparse.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Samples a and b attract each other, eq. 6.2 and 6.3: f_a = k (x_b - x_a) - eta v_a, and the same with a and b
/// exchanged. The damping is against the air, whose velocity is 0 in dressing; it acts on the control points of the
/// sample, eta W_ai v_i at point i, which sums to eta v_a.
struct Stitch {
  int a = 0, b = 0;
  double stiffness_N_per_m = 0;
  double damping_kg_per_s = 0;
};

/// Adds the elastic forces to those of the free points [N]; they sum to zero. Rows of WT are samples.
void addStitchForces(std::span<const Stitch> stitches, const SparseRows& WT, std::span<const Vec3> p,
                     std::span<Vec3> force);

/// Adds what damps each free point [kg/s].
void addStitchDamping(std::span<const Stitch> stitches, const SparseRows& WT, std::span<double> drag_kg_per_s);

/// 1/2 k |x_b - x_a|^2, summed [J].
double stitchEnergy(std::span<const Stitch> stitches, const SparseRows& WT, std::span<const Vec3> p);

/// The largest distance of a pair [m]; 0 without pairs.
double widestStitch(std::span<const Stitch> stitches, const SparseRows& WT, std::span<const Vec3> p);

}  // namespace gambeson
