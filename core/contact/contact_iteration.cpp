#include "core/contact/contact_iteration.hpp"

#include <algorithm>
#include <cmath>

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
constexpr int kChunk = 64;  ///< rows whose sums are taken together
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
      sum += w.share[row] * (V4{weight, weight, weight, size} * quad(w.point[row]));
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
    if (w.share[k] == 0) continue;  // stays zero
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
    const Vec3 next =
        project(from - step * (Vec3{v[0], v[1], v[2]} + yields - facts.drift), facts.normal, facts.friction);
    const Vec3 way = next - from;
    largest2 = std::max(largest2, norm2(way) * (inverse * inverse));
    if (exact) continue;
    const double* before = w.previous[k].lane;
    against -= w.share[k] * inverse * dot(way, next - Vec3{before[0], before[1], before[2]});
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
}

void iterate(double goal, int last_iteration, ContactSequence& sequence, ContactWork& w) {
  const int n = static_cast<int>(w.order.size()), sample_count = static_cast<int>(w.samples.size()),
            free_count = static_cast<int>(w.free_points.size()), chunks = (n + kChunk - 1) / kChunk;
  w.largest2.assign(chunks, 0);
  w.against.assign(chunks, 0);
  const ContactSequence start = sequence;
  // Every thread takes every decision, from the same sums in the same order.
#pragma omp parallel if (n > 1024)
  {
    ContactSequence now = start;
    now.done = false;
    const auto last = [&](int chunk) { return std::min(n, (chunk + 1) * kChunk); };
    const auto largest = [&] {
      double most2 = 0;
      for (double l : w.largest2) most2 = std::max(most2, l);
      return std::sqrt(most2);
    };
    for (; now.iterations < last_iteration && !now.done; ++now.iterations) {
#pragma omp for schedule(static)
      for (int k = 0; k < n; k += kChunk) extrapolate(w, now.beta, k, std::min(n, k + kChunk));
#pragma omp for schedule(static)
      for (int s = 0; s < sample_count; s += kChunk) gatherImpulses(w, s, std::min(sample_count, s + kChunk));
#pragma omp for schedule(static)
      for (int f = 0; f < free_count; f += kChunk) moveFreePoints(w, f, std::min(free_count, f + kChunk));
#pragma omp for schedule(static)
      for (int s = 0; s < sample_count; s += kChunk) moveSamples(w, s, std::min(sample_count, s + kChunk));
#pragma omp for schedule(static)
      for (int chunk = 0; chunk < chunks; ++chunk)
        projectRows(w, false, chunk * kChunk, last(chunk), w.largest2[chunk], w.against[chunk]);
      now.residual_m_per_s = largest();
      double against = 0;
      for (double a : w.against) against += a;
      if (now.residual_m_per_s <= goal || now.iterations + 1 == last_iteration) {
        // Longer steps than rho show a residual that is too small where the cone cuts it.
#pragma omp barrier
#pragma omp for schedule(static)
        for (int chunk = 0; chunk < chunks; ++chunk) {
          double unused;
          projectRows(w, true, chunk * kChunk, last(chunk), w.largest2[chunk], unused);
        }
        now.residual_m_per_s = largest();
        now.done = now.residual_m_per_s <= goal;
      }
      if (against > 0) {
        now.momentum = 1;
        now.beta = 0;
      } else {
        const double next = 0.5 * (1 + std::sqrt(1 + 4 * now.momentum * now.momentum));
        now.beta = (now.momentum - 1) / next;
        now.momentum = next;
      }
    }
#pragma omp master
    sequence = now;
  }
}

}  // namespace gambeson
