#include "core/cloth/triangles/quadratic_hinges.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/free_blocks.hpp"
#include "core/cloth/triangles/hinge_heights.hpp"
#include "core/cloth/triangles/lane_energies.hpp"
#include "core/cloth/triangles/point_block.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// Angles at rest below it are those of the numbers of a file [rad].
constexpr double kFlat_rad = 1e-6;

void check(const FoldHinge& hinge, const BlockLaw& law) {
  const auto reject = [](const char* reason) { throw InputError({"", 0, "bending_elements"}, reason); };
  if (law.use.kinds != 0)
    reject(
        "quadratic is for bending in proportion to curvature; allowed with it: the bending law linear, or, with "
        "this law, midedge, triangle, hinge");
  if (!(std::abs(hinge.theta0) <= kFlat_rad))
    reject(
        "quadratic is for cloth that is flat without stress, and this one has angles at rest; allowed with it: rest "
        "zero of the fabric's bending and rest fabric or uv of a mesh file, or, with these angles, midedge, "
        "triangle, hinge, springs");
}

bool acts(bool seam, const ForceTerms& terms) { return seam ? terms.seams : terms.bending; }

}  // namespace

QuadraticHinge quadraticHinge(const FoldHinge& hinge, const MembraneTriangle& first, const MembraneTriangle& second,
                              std::span<const double, 6> D) {
  const HingeHeights heights(hinge, first, second);
  const TriangleHeight &a = heights.first, &b = heights.second;
  // A kappa^2 d . D d = c theta^2, kappa = per_angle theta.
  const double root_c = hinge.per_angle * std::sqrt(hinge.area_m2 * rigidityAcross(hinge, D));
  const double of_a = root_c / a.height_m, of_b = root_c / b.height_m;
  return {hinge.corner, {-(a.foot_m / a.length_m * of_a + b.foot_m / b.length_m * of_b), of_a, of_b}};
}

QuadraticHinges::QuadraticHinges(std::span<const FoldHinge> hinges, std::span<const MembraneTriangle> triangles,
                                 std::span<const BlockLaw> laws, const TriangleKernels& kernels, long first_slot,
                                 SlotGather& gather)
    : kernels_(kernels.bending), lanes_(kernels.lanes) {
  for (const FoldHinge& h : hinges) {
    const auto triangle = [&](std::size_t side) -> const MembraneTriangle& {
      return triangles[static_cast<std::size_t>(h.triangle[side])];
    };
    if (triangle(0).bending != BendingElements::quadratic) continue;
    const BlockLaw& law = laws[static_cast<std::size_t>(h.law)];
    check(h, law);
    parts_[h.seam ? 1 : 0].hinges.push_back(quadraticHinge(h, triangle(0), triangle(1), law.point.section.D));
  }
  for (Part& part : parts_) {
    part.first_slot = first_slot + slots_;
    part.block = packPoints(
        std::span<const QuadraticHinge>(part.hinges), lanes_, part.first_slot, gather,
        [](const QuadraticHinge& h, bool real) { return real ? h.weight : std::array<double, kStencilDoubles>{}; });
    slots_ += 12L * part.block.groups * lanes_;
  }
}

void QuadraticHinges::force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, double* slots,
                            ClothWork& work) const {
  LaneEnergies energies(work, out.energy);
  BlockLaw none;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    if (part.hinges.empty()) continue;
    const int lanes = part.block.groups * lanes_;
    double* const own = slots + part.first_slot;
    if (!acts(k == 1, terms)) {
      std::fill_n(own, 12L * lanes, 0.0);
      continue;
    }
    double* const energy = energies.start(lanes, none);
    kernels_->stencils(part.block, reinterpret_cast<const double*>(state.q.data()), own, energy);
    energies.add(none);
  }
}

void QuadraticHinges::addStiffness(const FreeMap& map, const ForceTerms& terms, BlockMatrix& K) const {
  std::vector<std::array<double, 9>> blocks(16);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (!acts(k == 1, terms)) continue;
    for (const QuadraticHinge& h : parts_[k].hinges) {
      const double weight[4] = {-(h.weight[0] + h.weight[1] + h.weight[2]), h.weight[0], h.weight[1], h.weight[2]};
      for (std::size_t I = 0; I < 4; ++I)
        for (std::size_t J = 0; J < 4; ++J)
          for (std::size_t d = 0; d < 3; ++d) blocks[4 * I + J][4 * d] = weight[I] * weight[J];
      addSymmetrised(map, h.corner, blocks, K);
    }
  }
}

}  // namespace gambeson
