#include "core/cloth/triangles/crossed_springs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cloth/free_blocks.hpp"
#include "core/cloth/triangles/lane_energies.hpp"
#include "core/material/laws/spring.hpp"

namespace gambeson {
namespace {

constexpr double kCurvature_per_m = 100;  ///< at which springs and hinges store the same

/// The height of a triangle on the edge that faces a corner, and the foot of that corner on it, from `from` on.
struct Height {
  double height_m = 0, foot_m = 0;

  Height(const MembraneTriangle& t, int corner, int from) {
    // Corners flat in the basis of the threads: the inverse of g.
    const double det = t.g[0].x * t.g[1].y - t.g[0].y * t.g[1].x;
    const Vec2 at[3] = {{}, {t.g[1].y / det, -t.g[1].x / det}, {-t.g[0].y / det, t.g[0].x / det}};
    const auto find = [&](int c) { return std::find(t.corner.begin(), t.corner.end(), c) - t.corner.begin(); };
    const auto apex = find(corner), start = find(from), end = 3 - apex - start;
    const Vec2 e{at[end].x - at[start].x, at[end].y - at[start].y},
        a{at[apex].x - at[start].x, at[apex].y - at[start].y};
    const double length = std::hypot(e.x, e.y);
    height_m = std::abs(e.x * a.y - e.y * a.x) / length;
    foot_m = (e.x * a.x + e.y * a.y) / length;
  }
};

/// The corner of the second triangle at which the edge starts: its own point there, which seams make another.
int startIn(const FoldHinge& h, const MembraneTriangle& second) {
  const auto apex = std::find(second.corner.begin(), second.corner.end(), h.corner[3]) - second.corner.begin();
  return second.corner[static_cast<std::size_t>((apex + 2) % 3)];  // it runs 1, 0, 3
}

}  // namespace

CrossedSpring crossedSpring(const FoldHinge& hinge, const MembraneTriangle& first, const MembraneTriangle& second,
                            std::span<const double, 6> D, double stiffness_N_per_m) {
  const Height a(first, hinge.corner[2], hinge.corner[0]), b(second, hinge.corner[3], startIn(hinge, second));
  const double along = a.foot_m - b.foot_m;
  const auto distance = [&](double theta) {
    return std::sqrt(along * along + a.height_m * a.height_m + b.height_m * b.height_m +
                     2 * a.height_m * b.height_m * std::cos(theta));
  };
  CrossedSpring spring{{hinge.corner[2], hinge.corner[3]}, distance(hinge.theta0), stiffness_N_per_m};
  if (stiffness_N_per_m > 0) return spring;
  const Vec3& d = hinge.d;
  const double rigidity = d.x * (D[0] * d.x + D[3] * d.y + D[4] * d.z) + d.y * (D[3] * d.x + D[1] * d.y + D[5] * d.z) +
                          d.z * (D[4] * d.x + D[5] * d.y + D[2] * d.z);
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
  const int count = static_cast<int>(springs_.size());
  block_.groups = (count + lanes_ - 1) / lanes_;
  block_.corners.resize(static_cast<std::size_t>(2 * block_.groups * lanes_));
  block_.rest.resize(block_.corners.size());
  for (int at = 0; at < block_.groups * lanes_; ++at) {
    const CrossedSpring& s = springs_[static_cast<std::size_t>(std::min(at, count - 1))];
    const auto first = static_cast<std::size_t>(2 * (at / lanes_) * lanes_ + at % lanes_),
               second = first + static_cast<std::size_t>(lanes_);
    block_.corners[first] = s.corner[0];
    block_.corners[second] = s.corner[1];
    block_.rest[first] = s.rest_m;
    block_.rest[second] = at < count ? s.stiffness_N_per_m : 0;
    if (at >= count) continue;
    const long slot = first_slot_ + 6L * (at / lanes_) * lanes_ + at % lanes_;
    gather.add(s.corner[0], slot, lanes_);
    gather.add(s.corner[1], slot + 3L * lanes_, lanes_);
  }
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

void CrossedSprings::addStiffness(const FreeMap& map, std::span<const Vec3> q, bool definite,
                                BlockMatrix& K) const {
  std::vector<std::array<double, 9>> blocks(4);
  for (const CrossedSpring& s : springs_) {
    const Vec3 way = q[static_cast<std::size_t>(s.corner[1])] - q[static_cast<std::size_t>(s.corner[0])];
    const SpringAnswer<double> answer = linearSpring<with_slope>(s.stiffness_N_per_m, s.rest_m, norm2(way));
    const Vec3 u = normalized(way);
    const double across = definite ? std::max(answer.across, 0.0) : answer.across;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double k = (i == j ? across : 0) + (answer.along - across) * u[i] * u[j];
        const auto e = static_cast<std::size_t>(3 * i + j);
        blocks[0][e] = blocks[3][e] = k;
        blocks[1][e] = blocks[2][e] = -k;
      }
    addSymmetrised(map, s.corner, blocks, K);
  }
}

}  // namespace gambeson
