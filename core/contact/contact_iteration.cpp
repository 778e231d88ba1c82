#include "core/contact/contact_iteration.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/contact/held_iteration.hpp"
#include "core/contact/iteration_lanes.hpp"

namespace gambeson {
namespace {

using Island = ContactWork::Island;

constexpr int kLarge = 2048;         ///< rows of an island that all threads share
constexpr double kLost = 1e3;        ///< times the least residual: momentum has run away
constexpr std::size_t kShared = 64;  ///< rows from which on threads share islands

/// The sum of the first `width` (a power of two) of some parts: neighbours in pairs, pairs of these and so on.
inline double sumOfParts(double* part, int width) {
  for (int step = 1; step < width; step *= 2)
    for (int i = 0; i < width; i += 2 * step) part[i] += part[i + step];
  return part[0];
}

/// What a change of a row's traction does to the points, with what goes along with them where they are held.
inline void pushHeld(ContactWork& w, int row, const Vec3& change) {
  const V4 impulse = w.row_area[row] * V4{change.x, change.y, change.z, 0};
  for (int e = w.pushes.offsets[row]; e < w.pushes.offsets[row + 1]; ++e)
    quad(w.moved[w.pushes.columns[e]]) += w.pushes.values[e] * impulse;
}

/// The same where nothing holds them.
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

/// Takes the rows of a chunk from where they go on to, by beta of their last change. Sets the largest squared residual
/// as the rows found it, and the product that tells whether the step went against the gradient.
GAMBESON_WIDE void sweepRows(ContactWork& w, bool held, double beta, double caution, int begin, int end,
                             double& largest2_out, double& against_out) {
  double largest2 = 0, against[kSumLanes];
  const int width = std::min<int>(kSumLanes, std::bit_ceil(static_cast<unsigned>(end - begin)));
  std::fill_n(against, width, 0.0);
  for (int k = begin; k < end; ++k) {
    const ContactWork::Row& facts = w.facts[k];
    const Vec3 now = vec(w.candidate[k]), from = now + beta * (now - vec(w.previous[k]));
    const double bound = stepBound(facts, caution);
    const Vec3 next = takenFrom(from, velocityOf(w, k), 1 / bound, facts), way = next - from;
    largest2 = std::max(largest2, foundResidual2(way, bound));
    against[(k - begin) % kSumLanes] += againstGradient(w.row_area[k], bound, way, next - now);
    w.previous[k] = w.candidate[k];
    w.candidate[k] = quadOf(next);
    if (way == Vec3{}) continue;
    if (held)
      pushHeld(w, k, way);
    else
      push(w, k, way);
  }
  largest2_out = largest2;
  against_out = sumOfParts(against, width);
}

GAMBESON_WIDE double largestResidual2(const ContactWork& w, int begin, int end) {
  double largest2 = 0;
  for (int k = begin; k < end; ++k)
    largest2 = std::max(largest2, residual2(velocityOf(w, k), vec(w.candidate[k]), w.facts[k]));
  return largest2;
}

/// Visits the chunks of an island, those of one phase side by side: by the calling thread alone, or by all of a
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
  void finish(const Island&, bool, ContactWork&) const {}
};
/// Where points are held: the sweep's pushes are near to what the hold does; this is what it does, now and then and
/// wherever someone looks.
struct Held : Alone {
  void finish(const Island& island, bool looks, ContactWork& w) const {
    constexpr int kSweeps = 8;
    if (looks || island.iterations % kSweeps == kSweeps - 1) moveHeld(w.candidate, island, w, w.moved);
  }
};
struct Together {
  template <class Visit>
  void operator()(const ContactWork& w, const Island& island, const Visit& visit) const {
    for (int c = island.chunk, end; c < island.chunk_end; c = end) {
      for (end = c; end < island.chunk_end && w.chunks[end].phase == w.chunks[c].phase;) ++end;
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
  void finish(const Island&, bool, ContactWork&) const {}
};

/// Together, every thread takes every decision, from the same sums in the same order.
template <class EachChunk>
void iterateIsland(const SweepLimits& limits, Island& now, ContactWork& w, const EachChunk& each) {
  const auto mostOf = [&] {
    double most2 = 0;
    for (int c = now.chunk; c < now.chunk_end; ++c) most2 = std::max(most2, w.largest2[c]);
    return most2;
  };
  const auto sumOf = [&] {
    if (now.chunk_end - now.chunk == 1) return w.against[now.chunk];
    double part[kSumLanes] = {};
    for (int c = now.chunk; c < now.chunk_end; ++c) part[(c - now.chunk) % kSumLanes] += w.against[c];
    return sumOfParts(part, kSumLanes);
  };
  // Where points are held, sweeps with momentum may grow without end; from there on they go without.
  double least = 0;
  bool calm = false;
  while (goesOn(now, limits)) {
    const double caution = cautionOf(now), beta = calm ? 0 : now.beta;
    each.points(now, [&](int f, int end) { extrapolatePoints(w, beta, f, end); });
    each(w, now, [&](int c) {
      sweepRows(w, now.held, beta, caution, w.chunks[c].row, w.chunks[c + 1].row, w.largest2[c], w.against[c]);
    });
    const double against = sumOf();
    const bool looks = sweptWith(mostOf(), limits, now);
    if (now.held) {
      if (least == 0 || now.residual_m_per_s < least) least = now.residual_m_per_s;
      calm = calm || !(now.residual_m_per_s < kLost * least);
    }
    each.finish(now, looks, w);
    if (looks) {
      each.wait();
      each(w, now, [&](int c) { w.largest2[c] = largestResidual2(w, w.chunks[c].row, w.chunks[c + 1].row); });
      lookedAt(mostOf(), limits, now);
    }
    goOn(against, limits, aheadOf(now.momentum), now);
  }
}

}  // namespace

void startIteration(ContactWork& w) {
  const int n = static_cast<int>(w.order.size());
  for (int k = 0; k < n; ++k)
    w.candidate[k] = w.previous[k] = w.point[k] = quadOf(w.traction[k], w.traction[k] == Vec3{} ? 0.0 : 1.0);
  for (std::size_t f = 0; f < w.free_points.size(); ++f)
    w.moved[f] = quadOf(vec(w.base[f]) + w.change[w.free_points[f]]);
  holdPoints(w);
  w.moved_before = w.moved;
}

Vec3 slipOf(const ContactWork& w, int row) {
  const ContactWork::Row& facts = w.facts[row];
  const Vec3 over = velocityOf(w, row) - facts.drift;
  return over - dot(over, facts.normal) * facts.normal;
}

void iterate(double goal, int last, int most, ContactWork& w) {
  const SweepLimits limits{goal, last, most - most / 4};
  if (w.hold && !w.hold->projects()) {
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
    if (island.held) {
      iterateIsland(limits, island, w, Held{});
      continue;
    }
#pragma omp parallel
    {
      Island mine = island;
#pragma omp barrier
      iterateIsland(limits, mine, w, Together{});
#pragma omp master
      island = mine;
    }
  }
#pragma omp parallel for schedule(dynamic, 1) if (w.order.size() > kShared)
  for (int i = large; i < count; ++i) {
    Island& island = w.islands[w.by_size[i]];
    if (island.held)
      iterateIsland(limits, island, w, Held{});
    else
      iterateIsland(limits, island, w, Alone{});
  }
}

}  // namespace gambeson
