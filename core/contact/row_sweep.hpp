#pragma once
/// The arithmetic of a sweep over the rows of an island: one source for contact_iteration.cpp and for kernels
/// (gpu/solve). The same bits wherever multiply-add is not contracted and sums keep their order:
///   - the velocity of a row is a sum over its points in kWays parts, point e of the row in part e mod kWays, and then
///     (part 0 + part 1) + (part 2 + part 3), so that as many lanes take a row in a few steps;
///   - what a sweep sums over the rows of a chunk has kSumLanes parts, row k of the chunk in part k mod kSumLanes, and
///     then neighbours in pairs, pairs of these and so on; a sum over the chunks of an island likewise.

#include <algorithm>
#include <cmath>

#include "core/contact/contact_rows.hpp"

namespace gambeson {

constexpr int kWays = 4, kSumLanes = 64;

GAMBESON_LAW Vec3 projected(const Vec3& traction, const ContactWork::Row& facts) {
  return project(traction, facts.normal, facts.friction, facts.drag);
}

/// v - drift, and what the layer yields.
GAMBESON_LAW Vec3 missing(const Vec3& v, const Vec3& traction, const ContactWork::Row& facts) {
  return v + (facts.compliance * dot(traction, facts.normal)) * facts.normal - facts.drift;
}

/// Squared residual of a row as it is defined, |tau - P(tau - rho (v - drift))|/rho.
GAMBESON_LAW double residual2(const Vec3& v, const Vec3& traction, const ContactWork::Row& facts) {
  const Vec3 next = projected(traction - (1 / facts.slope) * missing(v, traction, facts), facts);
  return norm2(next - traction) * (facts.slope * facts.slope);
}

/// What the entry of a row's own traction is taken for; its inverse is the length of the step.
GAMBESON_LAW double stepBound(const ContactWork::Row& facts, double caution) {
  constexpr double kLeastOwn = 0.001;  // of the slope: what hardly moves takes no steps without bound
  return std::max(caution * facts.own, kLeastOwn * facts.slope) + facts.compliance;
}

/// The traction of a row that is taken once, from where it went on to after its last change.
GAMBESON_LAW Vec3 takenFrom(const Vec3& from, const Vec3& velocity, double length, const ContactWork::Row& facts) {
  return projected(from - length * missing(velocity, from, facts), facts);
}
/// About the squared residual of the row as it was found, `way` its change.
GAMBESON_LAW double foundResidual2(const Vec3& way, double bound) { return norm2(way) * (bound * bound); }
/// The product that tells whether the step went against the gradient, `change` since the sweep before.
GAMBESON_LAW double againstGradient(double area, double bound, const Vec3& way, const Vec3& change) {
  return -(area * bound * dot(way, change));
}

// Between the sweeps of an island; every lane takes every decision.

/// Where Nesterov's sequence goes from a momentum, if nothing is against it.
struct Ahead {
  double from, momentum, beta;
};
GAMBESON_HD inline Ahead aheadOf(double momentum) {
  const double next = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum));
  return {momentum, next, (momentum - 1) / next};
}
/// Sets the momentum of the island's next step, after a step whose product with the gradient is `against`.
GAMBESON_HD inline void advance(double against, const Ahead& ahead, ContactWork::Island& island) {
  if (against > 0) {
    island.momentum = 0.5 * (1 + island.momentum);
    island.beta = 0;
  } else {
    island.momentum = ahead.momentum;
    island.beta = ahead.beta;
  }
}
GAMBESON_HD inline void advance(double against, ContactWork::Island& island) {
  advance(against, aheadOf(island.momentum), island);
}

/// Longer steps than the least are tried first, since these converge fastest: on recorded solves of armour 1.2 is the
/// least that seldom goes round. What is alone is solved at once.
GAMBESON_HD inline double cautionOf(const ContactWork::Island& island) {
  constexpr double kCaution = 1.2;
  return island.row_end - island.row == 1 ? 1 : kCaution * island.caution;
}

/// Where the residual has not fallen for long, or has grown out of hand, the sequence begins anew with shorter steps.
GAMBESON_HD inline void watch(ContactWork::Island& island) {
  constexpr double kMoreCaution = 1.5, kMostCaution = 4 / 1.2, kProgress = 0.9, kGrown = 10;
  constexpr int kPatience = 120;
  if (island.best == 0 || island.residual_m_per_s < kProgress * island.best) {
    island.best = island.residual_m_per_s;
    island.waiting = 0;
  } else if (++island.waiting > kPatience || !(island.residual_m_per_s < kGrown * island.best)) {
    island.caution = std::min(kMoreCaution * island.caution, kMostCaution);
    island.best = 0;
    island.waiting = 0;
    island.momentum = 1;
    island.beta = 0;
  }
}

/// What a solve without a hold is done at [m/s], the velocities that its tractions at the start stand for being at most
/// `largest`.
GAMBESON_HD inline double goalOf(double tolerance_m_per_s, double largest_m_per_s) {
  constexpr double kOfLargest = 1e-6, kMostTolerances = 10;
  return std::max(tolerance_m_per_s, std::min(kOfLargest * largest_m_per_s, kMostTolerances * tolerance_m_per_s));
}
constexpr int kFirstCheck = 10;  ///< iterations before the rows that are left out are looked at; doubled each time

/// How far an iteration goes.
struct SweepLimits {
  double goal_m_per_s;
  int last;  ///< iterations that an island has at the end
  int calm;  ///< from so many iterations on there is no momentum
};
GAMBESON_HD inline bool goesOn(const ContactWork::Island& island, const SweepLimits& limits) {
  return island.iterations < limits.last && !island.done;
}
/// After a sweep that found the island with this residual, squared. Whether the residual must be looked at as it is
/// defined: what rows found on the way is about that.
GAMBESON_HD inline bool sweptWith(double largest2, const SweepLimits& limits, ContactWork::Island& island) {
  constexpr double kNear = 2;
  island.residual_m_per_s = std::sqrt(largest2);
  watch(island);
  return island.residual_m_per_s <= kNear * limits.goal_m_per_s || island.iterations + 1 == limits.last;
}
GAMBESON_HD inline void lookedAt(double largest2, const SweepLimits& limits, ContactWork::Island& island) {
  island.residual_m_per_s = std::sqrt(largest2);
  island.done = island.residual_m_per_s <= limits.goal_m_per_s;
}
/// To the next iteration; `ahead` of the momentum that the sweep had, known before the sweep ends.
GAMBESON_HD inline void goOn(double against, const SweepLimits& limits, const Ahead& ahead,
                             ContactWork::Island& island) {
  const bool anew = island.momentum != ahead.from;  // `watch` began the sequence again
  advance(against, anew ? aheadOf(island.momentum) : ahead, island);
  if (island.iterations + 1 >= limits.calm) island.beta = 0;
  ++island.iterations;
}

}  // namespace gambeson
