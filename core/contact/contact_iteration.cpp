#include "core/contact/contact_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contact/contact_rows.hpp"

namespace gambeson {
namespace {

// The loops of the iteration, over a range each. Four lanes: a vector and, in the last, what the bound D_s needs. The
// same operations in the same order whatever the instruction set: multiply-add is not contracted here.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GAMBESON_WIDE __attribute__((target_clones("avx2", "default"), noinline))
#else
#define GAMBESON_WIDE __attribute__((noinline))
#endif
using Quad = ContactWork::Quad;
typedef double V4 __attribute__((vector_size(32)));
constexpr int kChunk = 64;   ///< rows whose sums are taken together
constexpr int kLarge = 256;  ///< rows of an island that all threads share
inline const V4& quad(const Quad& q) { return *reinterpret_cast<const V4*>(&q); }
inline V4& quad(Quad& q) { return *reinterpret_cast<V4*>(&q); }

/// point = candidate + beta (candidate - previous), candidate becomes previous. The mark of a row that has carried
/// something stays until the sequence starts again: the bound, and with it the length of the steps, then follows the
/// rows that carry something now.
GAMBESON_WIDE void extrapolate(ContactWork& w, double beta, int begin, int end) {
  for (int k = begin; k < end; ++k) {
    const V4 c = quad(w.candidate[k]);
    V4& before = quad(w.previous[k]);
    V4 next = c + beta * (c - before);
    next[3] = beta == 0 ? (c[0] != 0 || c[1] != 0 || c[2] != 0 ? 1.0 : 0.0) : c[3];
    before = c;
    quad(w.point[k]) = next;
  }
}

/// Impulses of the samples.
GAMBESON_WIDE void gatherImpulses(ContactWork& w, int begin, int end) {
  for (int s = begin; s < end; ++s) {
    V4 sum{};
    for (int k = w.of_sample.offsets[s]; k < w.of_sample.offsets[s + 1]; ++k) {
      const int row = w.of_sample.columns[k];
      const double weight = w.of_sample.values[k], size = std::abs(weight);
      sum += w.row_area[row] * (V4{weight, weight, weight, size} * quad(w.point[row]));
    }
    quad(w.impulse[s]) = sum;
  }
}

GAMBESON_WIDE void moveFreePoints(ContactWork& w, int begin, int end) {
  for (int f = begin; f < end; ++f) {
    V4 sum{};
    for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k)
      sum += w.columns.values[k] * quad(w.impulse[w.columns.columns[k]]);
    quad(w.moved[f]) = quad(w.base[f]) + w.inverse_mass[f] * sum;
  }
}

/// What holds the points takes its part of their change.
void holdFreePoints(ContactWork& w) {
  if (!w.hold) return;
  w.change.resize(w.free_points.size());
  for (std::size_t f = 0; f < w.free_points.size(); ++f) {
    const double *now = w.moved[f].lane, *base = w.base[f].lane;
    w.change[f] = {now[0] - base[0], now[1] - base[1], now[2] - base[2]};
  }
  w.hold->holdTouched(w.change);
  for (std::size_t f = 0; f < w.free_points.size(); ++f) {
    double* const now = w.moved[f].lane;
    const double* const base = w.base[f].lane;
    const Vec3& d = w.change[f];
    now[0] = base[0] + d.x;
    now[1] = base[1] + d.y;
    now[2] = base[2] + d.z;
  }
}

GAMBESON_WIDE void moveSamples(ContactWork& w, int begin, int end) {
  for (int s = begin; s < end; ++s) {
    V4 v{};
    for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k)
      v += w.rows.values[k] * quad(w.moved[w.rows.columns[k]]);
    quad(w.velocity[s]) = v;
  }
}

/// Relative velocity of a row, and its bound.
inline void relative(const ContactWork& w, int row, V4& v) {
  v = V4{};
  for (int k = w.stencils.offsets[row]; k < w.stencils.offsets[row + 1]; ++k) {
    const double weight = w.stencils.values[k], size = std::abs(weight);
    v += V4{weight, weight, weight, size} * quad(w.velocity[w.stencils.columns[k]]);
  }
}

/// One projected step of the rows from `point` to `candidate`. Sets the largest squared residual of the range and the
/// product that tells whether the last step went against the gradient. `exact` takes the step rho everywhere and leaves
/// `candidate` alone: the residual as it is defined.
GAMBESON_WIDE void projectRows(ContactWork& w, bool exact, int begin, int end, double& largest2_out,
                               double& against_out) {
  double largest2 = 0, against = 0;
  for (int k = begin; k < end; ++k) {
    if (w.row_area[k] == 0) continue;  // stays zero
    V4 v;
    relative(w, k, v);
    const ContactWork::Row& facts = w.facts[k];
    const double bound = v[3] + facts.compliance;
    const double* at = w.point[k].lane;
    // A row without a mark is not in the bound yet.
    const double inverse = exact                                ? facts.slope  // of the step
                           : at[3] > 0 && bound < facts.largest ? std::max(bound, 0.05 * facts.largest)
                                                                : facts.largest;
    const double step = 1 / inverse;
    const Vec3 from{at[0], at[1], at[2]};
    const Vec3 yields = (facts.compliance * dot(from, facts.normal)) * facts.normal;
    const Vec3 next = project(from - step * (Vec3{v[0], v[1], v[2]} + yields - facts.drift), facts.normal,
                              facts.friction, facts.drag);
    const Vec3 way = next - from;
    largest2 = std::max(largest2, norm2(way) * (inverse * inverse));
    if (exact) continue;
    const double* before = w.previous[k].lane;
    against -= w.row_area[k] * inverse * dot(way, next - Vec3{before[0], before[1], before[2]});
    w.candidate[k] = {{next.x, next.y, next.z, at[3] > 0 || !(next == Vec3{}) ? 1.0 : 0.0}};
  }
  largest2_out = largest2;
  against_out = against;
}

inline Quad quadOf(const Vec3& v, double mark) { return {{v.x, v.y, v.z, mark}}; }

}  // namespace

void largestBounds(ContactWork& w) {
  const int n = static_cast<int>(w.order.size()), samples = static_cast<int>(w.samples.size()),
            free_count = static_cast<int>(w.free_points.size());
  for (int k = 0; k < n; ++k) w.point[k] = {{0, 0, 0, 1}};
  gatherImpulses(w, 0, samples);
  moveFreePoints(w, 0, free_count);
  moveSamples(w, 0, samples);
  for (int k = 0; k < n; ++k) {
    V4 v;
    relative(w, k, v);
    w.facts[k].largest = std::max(w.facts[k].slope, v[3] + w.facts[k].compliance);
  }
}

void startIteration(ContactWork& w) {
  const int n = static_cast<int>(w.order.size());
  for (int k = 0; k < n; ++k)
    w.candidate[k] = w.previous[k] = w.point[k] = quadOf(w.traction[k], w.traction[k] == Vec3{} ? 0.0 : 1.0);
  gatherImpulses(w, 0, static_cast<int>(w.samples.size()));
  moveFreePoints(w, 0, static_cast<int>(w.free_points.size()));
  holdFreePoints(w);
}

Vec3 slipOf(const ContactWork& w, int row) {
  V4 v;
  relative(w, row, v);
  const ContactWork::Row& facts = w.facts[row];
  const Vec3 over = Vec3{v[0], v[1], v[2]} - facts.drift;
  return over - dot(over, facts.normal) * facts.normal;
}

void moveDone(const ContactWork::Island& island, ContactWork& w) {
  for (int k = island.row; k < island.row_end; ++k) w.point[k] = w.candidate[k];
  gatherImpulses(w, island.sample, island.sample_end);
  moveFreePoints(w, island.free_point, island.free_end);
  holdFreePoints(w);
}

namespace {

using Island = ContactWork::Island;

/// Sets the momentum of the island's next step, after a step whose product with the gradient is `against`.
void advance(double against, Island& island) {
  if (against > 0) {
    island.momentum = 0.5 * (1 + island.momentum);
    island.beta = 0;
  } else {
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * island.momentum * island.momentum));
    island.beta = (island.momentum - 1) / next;
    island.momentum = next;
  }
}

/// Visits a range in chunks: by the calling thread alone, or by all of a parallel region.
struct Alone {
  template <class Visit>
  void operator()(int begin, int end, const Visit& visit) const {
    for (int k = begin; k < end; k += kChunk) visit(k, std::min(end, k + kChunk));
  }
  void wait() const {}
};
struct Together {
  template <class Visit>
  void operator()(int begin, int end, const Visit& visit) const {
#pragma omp for schedule(static)
    for (int k = begin; k < end; k += kChunk) visit(k, std::min(end, k + kChunk));
  }
  void wait() const {
#pragma omp barrier
  }
};

/// Together, every thread takes every decision, from the same sums in the same order.
template <class EachRange>
void iterateIsland(double goal, int last_iteration, Island& now, ContactWork& w, const EachRange& each) {
  const int chunks = (now.row_end - now.row + kChunk - 1) / kChunk;
  double* const largest2 = w.largest2.data() + now.chunk;
  double* const against = w.against.data() + now.chunk;
  const auto project = [&](bool exact) {
    each(now.row, now.row_end, [&](int k, int end) {
      const int chunk = (k - now.row) / kChunk;
      double unused;
      projectRows(w, exact, k, end, largest2[chunk], exact ? unused : against[chunk]);
    });
    double most2 = 0;
    for (int c = 0; c < chunks; ++c) most2 = std::max(most2, largest2[c]);
    return std::sqrt(most2);
  };
  for (; now.iterations < last_iteration && !now.done; ++now.iterations) {
    each(now.row, now.row_end, [&](int k, int end) { extrapolate(w, now.beta, k, end); });
    each(now.sample, now.sample_end, [&](int s, int end) { gatherImpulses(w, s, end); });
    each(now.free_point, now.free_end, [&](int f, int end) { moveFreePoints(w, f, end); });
    holdFreePoints(w);
    each(now.sample, now.sample_end, [&](int s, int end) { moveSamples(w, s, end); });
    now.residual_m_per_s = project(false);
    double sum = 0;
    for (int c = 0; c < chunks; ++c) sum += against[c];
    if (now.residual_m_per_s <= goal || now.iterations + 1 == last_iteration) {
      // Longer steps than rho show a residual that is too small where the cone cuts it.
      each.wait();
      now.residual_m_per_s = project(true);
      now.done = now.residual_m_per_s <= goal;
    }
    advance(sum, now);
  }
}

}  // namespace

void iterate(double goal, int last, ContactWork& w) {
  const auto size = [&](int i) { return w.islands[i].row_end - w.islands[i].row; };
  w.by_size.resize(w.islands.size());
  std::iota(w.by_size.begin(), w.by_size.end(), 0);
  std::stable_sort(w.by_size.begin(), w.by_size.end(), [&](int a, int b) { return size(a) > size(b); });
  const int count = static_cast<int>(w.islands.size());
  int large = 0;
  for (; large < count && size(w.by_size[large]) > kLarge && !w.hold; ++large) {
    Island& island = w.islands[w.by_size[large]];
#pragma omp parallel
    {
      Island mine = island;
#pragma omp barrier
      iterateIsland(goal, last, mine, w, Together{});
#pragma omp master
      island = mine;
    }
  }
#pragma omp parallel for schedule(dynamic, 1) if (w.order.size() > kLarge / 4)
  for (int i = large; i < count; ++i) iterateIsland(goal, last, w.islands[w.by_size[i]], w, Alone{});
}

}  // namespace gambeson
