#include "core/contact/response.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gambeson {
namespace {

/// Of a pressure, in its mean over the relaxation time.
double countsAtMost(double mean_Pa, double density) { return 2 * mean_Pa + 9.81 * density; }

/// Restricts W_T to the samples and free points that the contacts touch.
void restrict(std::span<const ContactRow> rows, const SparseRows& WT, ContactWork& w) {
  w.sample_slot.resize(WT.rows(), -1);
  w.free_slot.resize(WT.column_count, -1);
  for (int s : w.samples) w.sample_slot[s] = -1;
  for (int f : w.free_points) w.free_slot[f] = -1;
  w.samples.clear();
  w.free_points.clear();
  const auto clear = [](SparseRows& m) {
    m.offsets.assign(1, 0);
    m.columns.clear();
    m.values.clear();
  };
  clear(w.stencils);
  for (int i : w.order) {
    const Stencil& stencil = rows[i].stencil;
    for (int k = 0; k < stencil.count; ++k) {
      int& slot = w.sample_slot[stencil.sample[k]];
      if (slot < 0) {
        slot = static_cast<int>(w.samples.size());
        w.samples.push_back(stencil.sample[k]);
      }
      w.stencils.add(slot, stencil.weight[k]);
    }
    w.stencils.endRow();
  }
  w.stencils.column_count = static_cast<int>(w.samples.size());
  w.of_sample = transpose(w.stencils);
  clear(w.rows);
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

/// The area that each row stands for; 0 where only held points carry its samples.
void shareAreas(std::span<const ContactRow> rows, std::span<const double> area, std::span<const double> inverse_mass,
                ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  // Contacts of one sample share its area.
  std::vector<int> on_body(w.samples.size(), 0), on_cloth(w.samples.size(), 0);
  const auto owner = [&](int i) { return w.sample_slot[rows[i].contact.sample]; };
  for (int i = 0; i < n; ++i) {
    if (rows[i].contact.obstacle == kEdgeOnEdge || rows[i].contact.obstacle == kRestoring) continue;
    ++(rows[i].contact.obstacle < 0 ? on_cloth : on_body)[owner(i)];
  }
  w.share.resize(n);
  for (int at = 0; at < n; ++at) {
    const int i = w.order[at];
    const Stencil& stencil = rows[i].stencil;
    double mobility = 0;
    for (int k = 0; k < stencil.count; ++k) {
      const int s = w.sample_slot[stencil.sample[k]];
      for (int e = w.rows.offsets[s]; e < w.rows.offsets[s + 1]; ++e)
        mobility += w.rows.values[e] * w.rows.values[e] * inverse_mass[w.free_points[w.rows.columns[e]]];
    }
    double a = 0;
    if (rows[i].contact.obstacle == kEdgeOnEdge || rows[i].contact.obstacle == kRestoring ||
        (rows[i].contact.obstacle >= 0 && stencil.count > 1)) {
      for (int k = 0; k < stencil.count; ++k) a += 0.125 * std::abs(stencil.weight[k]) * area[stencil.sample[k]];
    } else if (rows[i].contact.obstacle == kSampleOnCloth) {
      a = 0.5 * area[rows[i].contact.sample] / on_cloth[owner(i)];
    } else {
      a = area[rows[i].contact.sample] / on_body[owner(i)];
    }
    w.share[at] = mobility > 0 ? a : 0;
  }
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
/// traction on the basis, sum_I N_I (sum_s N_I a tau)/(sum_s N_I a), which keeps constants. Sets w.traction. Contacts
/// of samples on cloth have no direction in common with the others around: theirs take the projection of their normal
/// parts, the two sides of the cloth apart, told by the normal's sign along a direction that no usual sheet lies in.
void smoothWarm(std::span<const ContactRow> rows, std::span<const Vec3> warm, ContactWork& w) {
  constexpr double kMix = 0.2;
  const Vec3 side{0.6180, 0.4142, 0.7321};
  const int n = static_cast<int>(rows.size()), free_count = static_cast<int>(w.free_points.size());
  for (int at = 0; at < n; ++at) w.traction[at] = warm[w.order[at]];
  // Bodies, then both sides of the cloth.
  for (int group = 0; group < 3; ++group) {
    const auto smoothed = [&](int at) {
      const ContactRow& row = rows[w.order[at]];
      if (warm[w.order[at]] == Vec3{}) return false;
      if (group == 0) return row.contact.obstacle >= 0 && row.stencil.count == 1;
      return row.contact.obstacle == kSampleOnCloth && (dot(row.contact.normal, side) > 0) == (group == 1);
    };
    const auto part = [&](int at) {
      const Vec3& t = warm[w.order[at]];
      return group == 0 ? t : Vec3{dot(t, rows[w.order[at]].contact.normal), 0, 0};
    };
    const auto sampleOf = [&](int at) { return w.sample_slot[rows[w.order[at]].contact.sample]; };
    bool any = false;
    w.weight.assign(w.samples.size(), 0);
    w.sample_impulse.assign(w.samples.size(), Vec3{});
    for (int at = 0; at < n; ++at) {
      if (!smoothed(at)) continue;
      any = true;
      w.weight[sampleOf(at)] += w.share[at];
      w.sample_impulse[sampleOf(at)] += w.share[at] * part(at);
    }
    if (!any) continue;
    for (int f = 0; f < free_count; ++f) {
      Vec3 sum{};
      double total = 0;
      for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k) {
        sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
        total += w.columns.values[k] * w.weight[w.columns.columns[k]];
      }
      w.free_velocity[f] = total > 0 ? sum / total : Vec3{};
    }
    for (int at = 0; at < n; ++at) {
      if (!smoothed(at)) continue;
      Vec3 smooth{};
      for (int k = w.rows.offsets[sampleOf(at)]; k < w.rows.offsets[sampleOf(at) + 1]; ++k)
        smooth += w.rows.values[k] * w.free_velocity[w.rows.columns[k]];
      const Vec3 change = kMix * (smooth - part(at));
      w.traction[at] += group == 0 ? change : change.x * rows[w.order[at]].contact.normal;
    }
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
constexpr int kChunk = 64;  ///< rows whose sums are taken together
inline const V4& quad(const Quad& q) { return *reinterpret_cast<const V4*>(&q); }
inline V4& quad(Quad& q) { return *reinterpret_cast<V4*>(&q); }

/// point = candidate + beta (candidate - previous), candidate becomes previous. The mark of a row that has carried
/// something stays.
GAMBESON_WIDE void extrapolate(ContactWork& w, double beta, int begin, int end) {
  for (int k = begin; k < end; ++k) {
    const V4 c = quad(w.candidate[k]);
    V4& before = quad(w.previous[k]);
    V4 next = c + beta * (c - before);
    next[3] = c[3];
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

/// What the bounds of the rows would be if all carried something.
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

/// Nesterov's sequence (O'Donoghue and Candes, 2015, restart by the gradient) from w.traction; leaves the result there.
ContactSolve iterate(ContactWork& w, const ContactParameters& c, double dt) {
  const int n = static_cast<int>(w.traction.size()), sample_count = static_cast<int>(w.samples.size()),
            free_count = static_cast<int>(w.free_points.size()), chunks = (n + kChunk - 1) / kChunk;
  const double goal = c.tolerance_m_per_s2 * dt;
  w.largest2.assign(chunks, 0);
  w.against.assign(chunks, 0);
  largestBounds(w);
  for (int k = 0; k < n; ++k) {
    const Vec3& t = w.traction[k];
    w.candidate[k] = w.previous[k] = {{t.x, t.y, t.z, t == Vec3{} ? 0.0 : 1.0}};
  }
  ContactSolve report;
  report.converged = false;
  // Every thread takes every decision, from the same sums in the same order.
#pragma omp parallel if (n > 1024)
  {
    double beta = 0, momentum = 1, residual = 0;
    const auto last = [&](int chunk) { return std::min(n, (chunk + 1) * kChunk); };
    const auto largest = [&] {
      double most2 = 0;
      for (double l : w.largest2) most2 = std::max(most2, l);
      return std::sqrt(most2);
    };
    int it = 0;
    bool done = false;
    for (; it < c.max_iterations && !done; ++it) {
#pragma omp for schedule(static)
      for (int k = 0; k < n; k += kChunk) extrapolate(w, beta, k, std::min(n, k + kChunk));
#pragma omp for schedule(static)
      for (int s = 0; s < sample_count; s += kChunk) gatherImpulses(w, s, std::min(sample_count, s + kChunk));
#pragma omp for schedule(static)
      for (int f = 0; f < free_count; f += kChunk) moveFreePoints(w, f, std::min(free_count, f + kChunk));
#pragma omp for schedule(static)
      for (int s = 0; s < sample_count; s += kChunk) moveSamples(w, s, std::min(sample_count, s + kChunk));
#pragma omp for schedule(static)
      for (int chunk = 0; chunk < chunks; ++chunk)
        projectRows(w, false, chunk * kChunk, last(chunk), w.largest2[chunk], w.against[chunk]);
      residual = largest();
      double against = 0;
      for (double a : w.against) against += a;
      if (residual <= goal || it + 1 == c.max_iterations) {
        // Longer steps than rho show a residual that is too small where the cone cuts it.
#pragma omp barrier
#pragma omp for schedule(static)
        for (int chunk = 0; chunk < chunks; ++chunk) {
          double unused;
          projectRows(w, true, chunk * kChunk, last(chunk), w.largest2[chunk], unused);
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
  for (int k = 0; k < n; ++k) w.traction[k] = {w.candidate[k].lane[0], w.candidate[k].lane[1], w.candidate[k].lane[2]};
  return report;
}

}  // namespace

ContactRow bodyRow(const Contact& contact, const Vec3& body_velocity, double target, bool impact) {
  ContactRow row{contact, {}, body_velocity, target, impact};
  row.stencil.add(contact.sample, 1);
  return row;
}

double persistentTarget(double gap, double dt, const ContactParameters& c) {
  const double depth = c.layer_m - gap;
  return depth > 0 ? -std::expm1(-dt / c.relaxation_s) * depth / dt : depth / dt;
}

double lastingPressure(double mean, double pressure, double dt, double density, const ContactParameters& c) {
  return mean - std::expm1(-dt / c.relaxation_s) * (std::min(pressure, countsAtMost(mean, density)) - mean);
}

void layerUnder(double last, double dt, double density, const ContactParameters& c, ContactRow& row) {
  const double gap = row.contact.gap_m;
  row.target_m_per_s = persistentTarget(gap, dt, c);
  row.compliance = 0;
  if (!atLayer(gap, c.layer_m)) return;
  const double k = -std::expm1(-dt / c.relaxation_s), gives = k * c.compliance_m_per_Pa / dt;
  const double counted = last > 0 ? std::min(1.0, countsAtMost(row.mean_Pa, density) / last) : row.mean_Pa > 0;
  row.target_m_per_s -= gives * (1 - k) * row.mean_Pa;
  row.compliance = gives * k * counted / dt;
}

ContactSolve solveContacts(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                           std::span<const double> area, std::span<const double> density, const ContactParameters& c,
                           double dt, std::span<Vec3> velocity, std::span<Vec3> warm, std::vector<Vec3>& impulses,
                           ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  impulses.assign(n, {});
  if (n == 0) return {};
  // Rows of one sample side by side.
  w.order.resize(n);
  std::iota(w.order.begin(), w.order.end(), 0);
  std::stable_sort(w.order.begin(), w.order.end(),
                   [&](int a, int b) { return rows[a].stencil.sample[0] < rows[b].stencil.sample[0]; });
  restrict(rows, WT, w);
  const int sample_count = static_cast<int>(w.samples.size()), free_count = static_cast<int>(w.free_points.size());
  shareAreas(rows, area, inverse_mass, w);

  w.free_velocity.resize(free_count);
  w.traction.resize(n);
  smoothWarm(rows, warm, w);
  w.facts.resize(n);
  for (auto* rows_of : {&w.point, &w.candidate, &w.previous}) rows_of->resize(n);
  w.impulse.resize(sample_count);
  w.velocity.resize(sample_count);
  w.base.resize(free_count);
  w.moved.resize(free_count);
  w.inverse_mass.resize(free_count);
  for (int k = 0; k < n; ++k) {
    const ContactRow& row = rows[w.order[k]];
    Vec3& t = w.traction[k];
    const double friction = row.slippery ? 0 : c.friction;
    t = w.share[k] > 0 ? project(t, row.contact.normal, friction) : Vec3{};
    double slope = 0;
    for (int j = 0; j < row.stencil.count; ++j)
      slope += std::abs(row.stencil.weight[j]) / density[row.stencil.sample[j]];
    slope += row.compliance;
    w.facts[k] = {row.contact.normal,
                  row.body_velocity + row.target_m_per_s * row.contact.normal,
                  friction,
                  row.compliance,
                  slope,
                  slope};
  }
  for (int f = 0; f < free_count; ++f) {
    const Vec3& v = velocity[w.free_points[f]];
    w.base[f] = {{v.x, v.y, v.z, 0}};
    w.inverse_mass[f] = inverse_mass[w.free_points[f]];
  }
  const ContactSolve report = iterate(w, c, dt);

  w.sample_impulse.assign(sample_count, Vec3{});
  for (int k = 0; k < n; ++k) {
    const int i = w.order[k];
    warm[i] = w.traction[k];
    impulses[i] = w.share[k] * w.traction[k];
    for (int e = w.stencils.offsets[k]; e < w.stencils.offsets[k + 1]; ++e)
      w.sample_impulse[w.stencils.columns[e]] += w.stencils.values[e] * impulses[i];
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
