#include "core/cloth/triangles/crossed_springs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cloth/spring_stiffness.hpp"
#include "core/cloth/triangles/hinge_heights.hpp"
#include "core/cloth/triangles/lane_energies.hpp"
#include "core/cloth/triangles/point_block.hpp"
#include "core/material/laws/spring.hpp"

namespace gambeson {
namespace {

constexpr double kCurvature_per_m = 100;  ///< at which springs and hinges store the same

}  // namespace

CrossedSpring crossedSpring(const FoldHinge& hinge, const MembraneTriangle& first, const MembraneTriangle& second,
                            std::span<const double, 6> D, double stiffness_N_per_m) {
  const HingeHeights heights(hinge, first, second);
  const TriangleHeight &a = heights.first, &b = heights.second;
  const double along = a.foot_m - b.foot_m;
  const auto distance = [&](double theta) {
    return std::sqrt(along * along + a.height_m * a.height_m + b.height_m * b.height_m +
                     2 * a.height_m * b.height_m * std::cos(theta));
  };
  CrossedSpring spring{{hinge.corner[2], hinge.corner[3]}, distance(hinge.theta0), stiffness_N_per_m};
  if (stiffness_N_per_m > 0) return spring;
  const double rigidity = rigidityAcross(hinge, D);
  const double fold = std::min(kCurvature_per_m / hinge.per_angle, 0.5 * std::numbers::pi),
               curvature = hinge.per_angle * fold;
  double shorter2 = 0;  // mean of both senses
  for (const double sense : {-1, 1}) {
    const double change = distance(hinge.theta0 + sense * fold) - spring.rest_m;
    shorter2 += 0.5 * change * change;
  }
  spring.stiffness_N_per_m = hinge.area_m2 * rigidity * curvature * curvature / shorter2;
  return spring;
}

CrossedSprings::CrossedSprings(std::vector<CrossedSpring> springs, const TriangleKernels& kernels, long first_slot,
                               SlotGather& gather)
    : springs_(std::move(springs)), kernels_(kernels.bending), lanes_(kernels.lanes), first_slot_(first_slot) {
  block_ = packPoints(std::span<const CrossedSpring>(springs_), lanes_, first_slot_, gather,
                      [](const CrossedSpring& s, bool real) {
                        return std::array<double, kSpringElementDoubles>{s.rest_m, real ? s.stiffness_N_per_m : 0};
                      });
}

void CrossedSprings::force(const ClothState& state, const ClothForce& out, bool bends, double* slots,
                           ClothWork& work) const {
  if (springs_.empty()) return;
  double* const own = slots + first_slot_;
  if (!bends) return std::fill_n(own, 6L * block_.groups * lanes_, 0.0), void();
  LaneEnergies energies(work, out.energy);
  BlockLaw none;
  double* const energy = energies.start(block_.groups * lanes_, none);
  kernels_->springs(block_, reinterpret_cast<const double*>(state.q.data()), own, energy);
  energies.add(none);
}

void CrossedSprings::addStiffness(const FreeMap& map, std::span<const Vec3> q, bool definite, BlockMatrix& K) const {
  for (const CrossedSpring& s : springs_) {
    const Vec3 way = q[static_cast<std::size_t>(s.corner[1])] - q[static_cast<std::size_t>(s.corner[0])];
    addSpringStiffness(map, s.corner, way, linearSpring<with_slope>(s.stiffness_N_per_m, s.rest_m, norm2(way)),
                       definite, K);
  }
}

}  // namespace gambeson
