#include "core/contact/contact_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contact/held_iteration.hpp"
#include "core/contact/iteration_lanes.hpp"

namespace gambeson {
namespace {

using Island = ContactWork::Island;

constexpr int kLarge = 2048;         ///< rows of an island that all threads share
constexpr std::size_t kShared = 64;  ///< rows from which on threads share islands

/// Relative velocity of a row at w.moved.
inline Vec3 velocityOf(const ContactWork& w, int row) {
  V4 even{}, odd{};
  int e = w.points.offsets[row];
  const int end = w.points.offsets[row + 1];
  for (; e + 1 < end; e += 2) {
    even += w.points.values[e] * quad(w.moved[w.points.columns[e]]);
    odd += w.points.values[e + 1] * quad(w.moved[w.points.columns[e + 1]]);
  }
  if (e < end) even += w.points.values[e] * quad(w.moved[w.points.columns[e]]);
  even += odd;
  return {even[0], even[1], even[2]};
}

/// What a change of a row's traction does to the points.
inline void push(ContactWork& w, int row, const Vec3& change) {
  const V4 impulse = w.row_area[row] * V4{change.x, change.y, change.z, 0};
  for (int e = w.points.offsets[row]; e < w.points.offsets[row + 1]; ++e) {
    const int f = w.points.columns[e];
    quad(w.moved[f]) += (w.points.values[e] * w.inverse_mass[f]) * impulse;
  }
}

/// Points go on along their last change, by beta of it.
GAMBESON_WIDE void extrapolatePoints(ContactWork& w, double beta, int begin, int end) {
  for (int f = begin; f < end; ++f) {
    const V4 now = quad(w.moved[f]);
    quad(w.moved[f]) = now + beta * (now - quad(w.moved_before[f]));
    quad(w.moved_before[f]) = now;
  }
}

/// Takes rows of one colour from where they go on to, by beta of their last change. Sets the largest squared residual
/// of the range as the rows found it, and the product that tells whether the step went against the gradient.
GAMBESON_WIDE void sweepRows(ContactWork& w, double beta, double caution, int begin, int end, double& largest2_out,
                             double& against_out) {
  constexpr double kLeastOwn = 0.001;  // of the slope: what hardly moves takes no steps without bound
  double largest2 = 0, against = 0;
  for (int k = begin; k < end; ++k) {
    const ContactWork::Row& facts = w.facts[k];
    const Vec3 now = vec(w.candidate[k]), from = now + beta * (now - vec(w.previous[k]));
    const double inverse = std::max(caution * facts.own, kLeastOwn * facts.slope) + facts.compliance;
    const Vec3 next = projected(from - (1 / inverse) * missing(velocityOf(w, k), from, facts), facts);
    const Vec3 way = next - from;
    largest2 = std::max(largest2, norm2(way) * (inverse * inverse));
    against -= w.row_area[k] * inverse * dot(way, next - now);
    w.previous[k] = w.candidate[k];
    w.candidate[k] = quadOf(next);
    if (!(way == Vec3{})) push(w, k, way);
  }
  largest2_out = largest2;
  against_out = against;
}

GAMBESON_WIDE double largestResidual2(const ContactWork& w, int begin, int end) {
  double largest2 = 0;
  for (int k = begin; k < end; ++k)
    largest2 = std::max(largest2, residual2(velocityOf(w, k), vec(w.candidate[k]), w.facts[k]));
  return largest2;
}

/// Where the residual has not fallen for long, or has grown out of hand, the sequence begins anew with shorter steps.
/// Longer ones than the least are tried first, since these converge fastest: on recorded solves of armour 1.2 is the
/// least that seldom goes round.
constexpr double kCaution = 1.2, kMoreCaution = 1.5, kMostCaution = 4, kProgress = 0.9, kGrown = 10;
constexpr int kPatience = 120;
void watch(Island& island) {
  if (island.best == 0 || island.residual_m_per_s < kProgress * island.best) {
    island.best = island.residual_m_per_s;
    island.waiting = 0;
  } else if (++island.waiting > kPatience || !(island.residual_m_per_s < kGrown * island.best)) {
    island.caution = std::min(kMoreCaution * island.caution, kMostCaution / kCaution);
    island.best = 0;
    island.waiting = 0;
    island.momentum = 1;
    island.beta = 0;
  }
}

/// Visits the chunks of an island, those of one colour side by side: by the calling thread alone, or by all of a
/// parallel region.
struct Alone {
  template <class Visit>
  void operator()(const ContactWork&, const Island& island, const Visit& visit) const {
    for (int c = island.chunk; c < island.chunk_end; ++c) visit(c);
  }
  template <class Visit>
  void points(const Island& island, const Visit& visit) const {
    visit(island.free_point, island.free_end);
  }
  void wait() const {}
};
struct Together {
  template <class Visit>
  void operator()(const ContactWork& w, const Island& island, const Visit& visit) const {
    for (int c = island.chunk, end; c < island.chunk_end; c = end) {
      for (end = c; end < island.chunk_end && w.chunks[end].colour == w.chunks[c].colour;) ++end;
#pragma omp for schedule(static)
      for (int k = c; k < end; ++k) visit(k);
    }
  }
  template <class Visit>
  void points(const Island& island, const Visit& visit) const {
    constexpr int kPoints = 256;
#pragma omp for schedule(static)
    for (int f = island.free_point; f < island.free_end; f += kPoints) visit(f, std::min(island.free_end, f + kPoints));
  }
  void wait() const {
#pragma omp barrier
  }
};

/// Together, every thread takes every decision, from the same sums in the same order. `calm`: from so many iterations
/// on there is no momentum.
template <class EachChunk>
void iterateIsland(double goal, int last_iteration, int calm, Island& now, ContactWork& w, const EachChunk& each) {
  constexpr double kNear = 2;  // what rows found on the way is about the residual
  const auto mostOf = [&] {
    double most2 = 0;
    for (int c = now.chunk; c < now.chunk_end; ++c) most2 = std::max(most2, w.largest2[c]);
    return std::sqrt(most2);
  };
  const bool alone = now.row_end - now.row == 1;  // is solved at once
  for (; now.iterations < last_iteration && !now.done; ++now.iterations) {
    const double caution = alone ? 1 : kCaution * now.caution;
    each.points(now, [&](int f, int end) { extrapolatePoints(w, now.beta, f, end); });
    each(w, now, [&](int c) {
      sweepRows(w, now.beta, caution, w.chunks[c].row, w.chunks[c + 1].row, w.largest2[c], w.against[c]);
    });
    now.residual_m_per_s = mostOf();
    double sum = 0;
    for (int c = now.chunk; c < now.chunk_end; ++c) sum += w.against[c];
    watch(now);
    if (now.residual_m_per_s <= kNear * goal || now.iterations + 1 == last_iteration) {
      each.wait();
      each(w, now, [&](int c) { w.largest2[c] = largestResidual2(w, w.chunks[c].row, w.chunks[c + 1].row); });
      now.residual_m_per_s = mostOf();
      now.done = now.residual_m_per_s <= goal;
    }
    advance(sum, now);
    if (now.iterations + 1 >= calm) now.beta = 0;
  }
}

}  // namespace

void startIteration(ContactWork& w) {
  const int n = static_cast<int>(w.order.size());
  for (int k = 0; k < n; ++k)
    w.candidate[k] = w.previous[k] = w.point[k] = quadOf(w.traction[k], w.traction[k] == Vec3{} ? 0.0 : 1.0);
  w.moved = w.base;
  for (int k = 0; k < n; ++k)
    if (!(w.traction[k] == Vec3{})) push(w, k, w.traction[k]);
  holdPoints(w);
  w.moved_before = w.moved;
}

Vec3 slipOf(const ContactWork& w, int row) {
  const ContactWork::Row& facts = w.facts[row];
  const Vec3 over = velocityOf(w, row) - facts.drift;
  return over - dot(over, facts.normal) * facts.normal;
}

void iterate(double goal, int last, int most, ContactWork& w) {
  const int calm = most - most / 4;
  if (w.hold) {
    iterateHeld(goal, last, w);
    return;
  }
  const auto size = [&](int i) { return w.islands[i].row_end - w.islands[i].row; };
  w.by_size.resize(w.islands.size());
  std::iota(w.by_size.begin(), w.by_size.end(), 0);
  std::stable_sort(w.by_size.begin(), w.by_size.end(), [&](int a, int b) { return size(a) > size(b); });
  const int count = static_cast<int>(w.islands.size());
  int large = 0;
  for (; large < count && size(w.by_size[large]) > kLarge; ++large) {
    Island& island = w.islands[w.by_size[large]];
#pragma omp parallel
    {
      Island mine = island;
#pragma omp barrier
      iterateIsland(goal, last, calm, mine, w, Together{});
#pragma omp master
      island = mine;
    }
  }
#pragma omp parallel for schedule(dynamic, 1) if (w.order.size() > kShared)
  for (int i = large; i < count; ++i) iterateIsland(goal, last, calm, w.islands[w.by_size[i]], w, Alone{});
}

}  // namespace gambeson
