#include "core/contact/response.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

/// Restricts W_T to the samples and free points that the contacts touch.
void restrict(std::span<const ContactRow> rows, const SparseRows& WT, ContactWork& w) {
  w.sample_slot.resize(WT.rows(), -1);
  w.free_slot.resize(WT.column_count, -1);
  for (int s : w.samples) w.sample_slot[s] = -1;
  for (int f : w.free_points) w.free_slot[f] = -1;
  w.samples.clear();
  w.free_points.clear();
  w.row_slot.clear();
  for (const ContactRow& row : rows) {
    int& slot = w.sample_slot[row.contact.sample];
    if (slot < 0) {
      slot = static_cast<int>(w.samples.size());
      w.samples.push_back(row.contact.sample);
    }
    w.row_slot.push_back(slot);
  }
  w.rows.offsets.assign(1, 0);
  w.rows.columns.clear();
  w.rows.values.clear();
  for (int s : w.samples) {
    for (int k = WT.offsets[s]; k < WT.offsets[s + 1]; ++k) {
      int& slot = w.free_slot[WT.columns[k]];
      if (slot < 0) {
        slot = static_cast<int>(w.free_points.size());
        w.free_points.push_back(WT.columns[k]);
      }
      w.rows.add(slot, WT.values[k]);
    }
    w.rows.endRow();
  }
  w.rows.column_count = static_cast<int>(w.free_points.size());
  w.columns = transpose(w.rows);
}

/// Onto the Coulomb cone of the row: normal part >= 0, tangential part within mu times it.
Vec3 project(const Vec3& traction, const Vec3& n, double mu) {
  const double tn = dot(traction, n);
  if (!(tn > 0)) return {};
  Vec3 tangential = traction - tn * n;
  const double size2 = norm2(tangential), limit = mu * tn;
  if (size2 > limit * limit) tangential *= limit / std::sqrt(size2);
  return tn * n + tangential;
}

/// Where samples outnumber control points, tractions have parts that move nothing; a solve neither makes nor removes
/// them, so what an impact left would stay. Each warm start moves a fifth of the way to the lumped projection of the
/// traction on the basis, sum_I N_I (sum_s N_I a tau)/(sum_s N_I a), which keeps constants. Sets w.traction.
void smoothWarm(std::span<const ContactRow> rows, std::span<const Vec3> warm, ContactWork& w) {
  constexpr double kMix = 0.2;
  const int sample_count = static_cast<int>(w.samples.size()), free_count = static_cast<int>(w.free_points.size());
  w.weight.assign(sample_count, 0);
  for (int s = 0; s < sample_count; ++s) {
    w.sample_impulse[s] = {};
    for (int k = w.first[s]; k < w.first[s + 1]; ++k) {
      if (warm[w.of_sample[k]] == Vec3{}) continue;
      w.weight[s] += w.share[s];
      w.sample_impulse[s] += w.share[s] * warm[w.of_sample[k]];
    }
  }
  for (int f = 0; f < free_count; ++f) {
    Vec3 sum{};
    double total = 0;
    for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k) {
      sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
      total += w.columns.values[k] * w.weight[w.columns.columns[k]];
    }
    w.free_velocity[f] = total > 0 ? sum / total : Vec3{};
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    w.traction[i] = warm[i];
    if (warm[i] == Vec3{}) continue;
    const int s = w.row_slot[i];
    Vec3 smooth{};
    for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k)
      smooth += w.rows.values[k] * w.free_velocity[w.rows.columns[k]];
    w.traction[i] += kMix * (smooth - warm[i]);
  }
}

// The loops of the iteration, over a range each. Four lanes: a vector and, in the last, what the bound D_s needs. The
// same operations in the same order whatever the instruction set: multiply-add is not contracted here.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GAMBESON_WIDE __attribute__((target_clones("avx2", "default"), noinline))
#else
#define GAMBESON_WIDE __attribute__((noinline))
#endif
using Quad = ContactWork::Quad;
typedef double V4 __attribute__((vector_size(32)));
constexpr int kChunk = 64;  ///< samples whose sums are taken together

/// point = candidate + beta (candidate - previous), candidate becomes previous; impulses of the samples. The mark of a
/// row that has carried something stays.
GAMBESON_WIDE void extrapolate(ContactWork& w, double beta, int begin, int end) {
  for (int s = begin; s < end; ++s) {
    V4 sum{};
    for (int k = w.first[s]; k < w.first[s + 1]; ++k) {
      const V4 c = *reinterpret_cast<const V4*>(&w.candidate[k]);
      V4& before = *reinterpret_cast<V4*>(&w.previous[k]);
      V4 next = c + beta * (c - before);
      next[3] = c[3];
      before = c;
      *reinterpret_cast<V4*>(&w.point[k]) = next;
      sum += next;
    }
    *reinterpret_cast<V4*>(&w.impulse[s]) = w.share[s] * sum;
  }
}

GAMBESON_WIDE void moveFreePoints(ContactWork& w, int begin, int end) {
  for (int f = begin; f < end; ++f) {
    V4 sum{};
    for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k)
      sum += w.columns.values[k] * *reinterpret_cast<const V4*>(&w.impulse[w.columns.columns[k]]);
    *reinterpret_cast<V4*>(&w.moved[f]) = *reinterpret_cast<const V4*>(&w.base[f]) + w.inverse_mass[f] * sum;
  }
}

/// One projected step of the samples' rows from `point` to `candidate`. Sets the largest squared residual of the range
/// and the product that tells whether the last step went against the gradient. `exact` takes the step rho everywhere
/// and leaves `candidate` alone: the residual as it is defined.
GAMBESON_WIDE void projectRows(ContactWork& w, double density, double mu, bool exact, int begin, int end,
                               double& largest2_out, double& against_out) {
  const double slope = 1 / density;
  double largest2 = 0, against = 0;
  for (int s = begin; s < end; ++s) {
    if (w.share[s] == 0) continue;  // its rows stay zero
    V4 v{};
    for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k)
      v += w.rows.values[k] * *reinterpret_cast<const V4*>(&w.moved[w.rows.columns[k]]);
    const double bound = v[3];
    for (int k = w.first[s]; k < w.first[s + 1]; ++k) {
      const double* at = w.point[k].lane;
      // A row without a mark is not in the bound yet.
      const double inverse =
          !exact && at[3] > 0 && bound < slope ? std::max(bound, 0.05 * slope) : slope;  // of the step
      const double step = 1 / inverse;
      const Vec3 from{at[0], at[1], at[2]};
      const Vec3 next = project(from - step * (Vec3{v[0], v[1], v[2]} - w.facts[k].drift), w.facts[k].normal, mu);
      const Vec3 way = next - from;
      largest2 = std::max(largest2, norm2(way) * (inverse * inverse));
      if (exact) continue;
      const double* before = w.previous[k].lane;
      against -= w.share[s] * inverse * dot(way, next - Vec3{before[0], before[1], before[2]});
      w.candidate[k] = {{next.x, next.y, next.z, at[3] > 0 || !(next == Vec3{}) ? 1.0 : 0.0}};
    }
  }
  largest2_out = largest2;
  against_out = against;
}

/// Nesterov's sequence (O'Donoghue and Candes, 2015, restart by the gradient) from w.traction; leaves the result there.
ContactSolve iterate(ContactWork& w, double density, const ContactParameters& c, double dt) {
  const int n = static_cast<int>(w.traction.size()), sample_count = static_cast<int>(w.samples.size()),
            free_count = static_cast<int>(w.free_points.size()), chunks = (sample_count + kChunk - 1) / kChunk;
  const double goal = c.tolerance_m_per_s2 * dt;
  w.largest2.assign(chunks, 0);
  w.against.assign(chunks, 0);
  for (int k = 0; k < n; ++k) {
    const Vec3& t = w.traction[w.of_sample[k]];
    w.candidate[k] = w.previous[k] = {{t.x, t.y, t.z, t == Vec3{} ? 0.0 : 1.0}};
  }
  ContactSolve report;
  report.converged = false;
  // Every thread takes every decision, from the same sums in the same order.
#pragma omp parallel if (n > 1024)
  {
    double beta = 0, momentum = 1, residual = 0;
    const auto last = [&](int chunk) { return std::min(sample_count, (chunk + 1) * kChunk); };
    const auto largest = [&] {
      double most2 = 0;
      for (double l : w.largest2) most2 = std::max(most2, l);
      return std::sqrt(most2);
    };
    int it = 0;
    bool done = false;
    for (; it < c.max_iterations && !done; ++it) {
#pragma omp for schedule(static)
      for (int chunk = 0; chunk < chunks; ++chunk) extrapolate(w, beta, chunk * kChunk, last(chunk));
#pragma omp for schedule(static)
      for (int f = 0; f < free_count; f += kChunk) moveFreePoints(w, f, std::min(free_count, f + kChunk));
#pragma omp for schedule(static)
      for (int chunk = 0; chunk < chunks; ++chunk)
        projectRows(w, density, c.friction, false, chunk * kChunk, last(chunk), w.largest2[chunk], w.against[chunk]);
      residual = largest();
      double against = 0;
      for (double a : w.against) against += a;
      if (residual <= goal || it + 1 == c.max_iterations) {
        // Longer steps than rho show a residual that is too small where the cone cuts it.
#pragma omp barrier
#pragma omp for schedule(static)
        for (int chunk = 0; chunk < chunks; ++chunk) {
          double unused;
          projectRows(w, density, c.friction, true, chunk * kChunk, last(chunk), w.largest2[chunk], unused);
        }
        residual = largest();
        done = residual <= goal;
      }
      if (against > 0) {
        momentum = 1;
        beta = 0;
      } else {
        const double next = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum));
        beta = (momentum - 1) / next;
        momentum = next;
      }
    }
#pragma omp master
    {
      report.iterations = it;
      report.residual_m_per_s = residual;
      report.converged = done;
    }
  }
  for (int k = 0; k < n; ++k)
    w.traction[w.of_sample[k]] = {w.candidate[k].lane[0], w.candidate[k].lane[1], w.candidate[k].lane[2]};
  return report;
}

}  // namespace

double persistentTarget(double gap, double dt, const ContactParameters& c) {
  const double depth = c.layer_m - gap;
  return depth > 0 ? -std::expm1(-dt / c.relaxation_s) * depth / dt : depth / dt;
}

ContactSolve solveContacts(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                           std::span<const double> area, double density, const ContactParameters& c, double dt,
                           std::span<Vec3> velocity, std::span<Vec3> warm, std::vector<Vec3>& impulses,
                           ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  impulses.assign(n, {});
  if (n == 0) return {};
  restrict(rows, WT, w);
  const int sample_count = static_cast<int>(w.samples.size()), free_count = static_cast<int>(w.free_points.size());
  // Contacts of one sample share its area, so that the bound on the operator holds.
  w.first.assign(sample_count + 1, 0);
  for (int slot : w.row_slot) ++w.first[slot + 1];
  w.share.resize(sample_count);
  for (int s = 0; s < sample_count; ++s) {
    // A sample that only held points carry cannot answer: it takes no part.
    double mobility = 0;
    for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k)
      mobility += w.rows.values[k] * w.rows.values[k] * inverse_mass[w.free_points[w.rows.columns[k]]];
    w.share[s] = mobility > 0 ? area[w.samples[s]] / w.first[s + 1] : 0;
  }
  for (int s = 0; s < sample_count; ++s) w.first[s + 1] += w.first[s];
  w.of_sample.resize(n);
  {
    std::vector<int> next(w.first.begin(), w.first.end() - 1);
    for (int i = 0; i < n; ++i) w.of_sample[next[w.row_slot[i]]++] = i;
  }

  w.sample_impulse.resize(sample_count);
  w.free_velocity.resize(free_count);
  w.traction.resize(n);
  smoothWarm(rows, warm, w);
  w.facts.resize(n);
  for (auto* rows_of : {&w.point, &w.candidate, &w.previous}) rows_of->resize(n);
  w.impulse.resize(sample_count);
  w.base.resize(free_count);
  w.moved.resize(free_count);
  w.inverse_mass.resize(free_count);
  for (int k = 0; k < n; ++k) {
    const ContactRow& row = rows[w.of_sample[k]];
    Vec3& t = w.traction[w.of_sample[k]];
    t = w.share[w.row_slot[w.of_sample[k]]] > 0 ? project(t, row.contact.normal, c.friction) : Vec3{};
    w.facts[k] = {row.contact.normal, row.body_velocity + row.target_m_per_s * row.contact.normal};
  }
  for (int f = 0; f < free_count; ++f) {
    const Vec3& v = velocity[w.free_points[f]];
    w.base[f] = {{v.x, v.y, v.z, 0}};
    w.inverse_mass[f] = inverse_mass[w.free_points[f]];
  }
  const ContactSolve report = iterate(w, density, c, dt);

  for (int s = 0; s < sample_count; ++s) {
    w.sample_impulse[s] = {};
    for (int k = w.first[s]; k < w.first[s + 1]; ++k) {
      const int i = w.of_sample[k];
      warm[i] = w.traction[i];
      impulses[i] = w.share[s] * w.traction[i];
      w.sample_impulse[s] += impulses[i];
    }
  }
  for (int f = 0; f < free_count; ++f) {
    Vec3 sum{};
    for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k)
      sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
    velocity[w.free_points[f]] += inverse_mass[w.free_points[f]] * sum;
  }
  return report;
}

}  // namespace gambeson
