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
  w.rows = {};
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
  const double size = norm(tangential), limit = mu * tn;
  if (size > limit) tangential *= limit / size;
  return tn * n + tangential;
}

/// Where samples outnumber control points, tractions have parts that move nothing; a solve neither makes nor removes them, so
/// what an impact left would stay. Each warm start moves a fifth of the way to the lumped projection of the traction on the
/// basis, sum_I N_I (sum_s N_I a tau)/(sum_s N_I a), which keeps constants. Sets w.traction.
void smoothWarm(std::span<const ContactRow> rows, std::span<const int> first, std::span<const int> of_sample,
                std::span<const double> share, std::span<const Vec3> warm, ContactWork& w) {
  constexpr double kMix = 0.2;
  const int sample_count = static_cast<int>(w.samples.size()), free_count = static_cast<int>(w.free_points.size());
  std::vector<double> weight(sample_count, 0);
  for (int s = 0; s < sample_count; ++s) {
    w.sample_impulse[s] = {};
    for (int k = first[s]; k < first[s + 1]; ++k) {
      if (warm[of_sample[k]] == Vec3{}) continue;
      weight[s] += share[s];
      w.sample_impulse[s] += share[s] * warm[of_sample[k]];
    }
  }
  for (int f = 0; f < free_count; ++f) {
    Vec3 sum{};
    double total = 0;
    for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k) {
      sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
      total += w.columns.values[k] * weight[w.columns.columns[k]];
    }
    w.free_velocity[f] = total > 0 ? sum / total : Vec3{};
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    w.traction[i] = warm[i];
    if (warm[i] == Vec3{}) continue;
    const int s = w.row_slot[i];
    Vec3 smooth{};
    for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k) smooth += w.rows.values[k] * w.free_velocity[w.rows.columns[k]];
    w.traction[i] += kMix * (smooth - warm[i]);
  }
}

}  // namespace

double persistentTarget(double gap, double dt, const ContactParameters& c) {
  const double depth = c.layer_m - gap;
  return depth > 0 ? -std::expm1(-dt / c.relaxation_s) * depth / dt : depth / dt;
}

ContactSolve solveContacts(std::span<const ContactRow> rows, const SparseRows& WT,
                           std::span<const double> inverse_mass, std::span<const double> area, double density,
                           const ContactParameters& c, double dt, std::span<Vec3> velocity, std::span<Vec3> warm, std::vector<Vec3>& impulses,
                           ContactWork& w) {
  const int n = static_cast<int>(rows.size());
  impulses.assign(n, {});
  if (n == 0) return {};
  restrict(rows, WT, w);
  const int sample_count = static_cast<int>(w.samples.size()), free_count = static_cast<int>(w.free_points.size());
  // Contacts of one sample share its area, so that the bound on the operator holds.
  std::vector<double> share(sample_count, 0);
  for (int slot : w.row_slot) share[slot] += 1;
  for (int s = 0; s < sample_count; ++s) {
    // A sample that only held points carry cannot answer: it takes no part.
    double mobility = 0;
    for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k)
      mobility += w.rows.values[k] * w.rows.values[k] * inverse_mass[w.free_points[w.rows.columns[k]]];
    share[s] = mobility > 0 ? area[w.samples[s]] / share[s] : 0;
  }
  std::vector<int> first(sample_count + 1, 0), of_sample(n);
  for (int slot : w.row_slot) ++first[slot + 1];
  for (int s = 0; s < sample_count; ++s) first[s + 1] += first[s];
  {
    std::vector<int> next(first.begin(), first.end() - 1);
    for (int i = 0; i < n; ++i) of_sample[next[w.row_slot[i]]++] = i;
  }

  w.sample_impulse.resize(sample_count);
  w.sample_velocity.resize(sample_count);
  w.free_velocity.resize(free_count);
  w.traction.resize(n);
  w.candidate.resize(n);
  w.point.resize(n);
  smoothWarm(rows, first, of_sample, share, warm, w);
  for (int i = 0; i < n; ++i)
    w.traction[i] = w.point[i] = share[w.row_slot[i]] > 0 ? project(w.traction[i], rows[i].contact.normal, c.friction) : Vec3{};

  ContactSolve report;
  report.converged = false;
  double momentum = 1;
  for (int it = 0; it < c.max_iterations; ++it) {
    double residual = 0;
#pragma omp parallel if (n > 256)
    {
#pragma omp for schedule(static)
      for (int s = 0; s < sample_count; ++s) {
        Vec3 sum{};
        for (int k = first[s]; k < first[s + 1]; ++k) sum += w.point[of_sample[k]];
        w.sample_impulse[s] = share[s] * sum;
      }
#pragma omp for schedule(static)
      for (int f = 0; f < free_count; ++f) {
        Vec3 sum{};
        for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k) sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
        const int at = w.free_points[f];
        w.free_velocity[f] = velocity[at] + inverse_mass[at] * sum;
      }
#pragma omp for schedule(static) reduction(max : residual)
      for (int s = 0; s < sample_count; ++s) {
        Vec3 v{};
        for (int k = w.rows.offsets[s]; k < w.rows.offsets[s + 1]; ++k) v += w.rows.values[k] * w.free_velocity[w.rows.columns[k]];
        for (int k = first[s]; k < first[s + 1]; ++k) {
          const int i = of_sample[k];
          if (share[s] == 0) {
            w.candidate[i] = {};
            continue;
          }
          const ContactRow& row = rows[i];
          const Vec3 excess = v - row.body_velocity - row.target_m_per_s * row.contact.normal;
          const Vec3 next = project(w.point[i] - density * excess, row.contact.normal, c.friction);
          residual = std::max(residual, norm(next - w.point[i]) / density);
          w.candidate[i] = next;
        }
      }
    }
    report.iterations = it + 1;
    report.residual_m_per_s = residual;
    if (residual <= c.tolerance_m_per_s2 * dt) {
      report.converged = true;
      std::swap(w.traction, w.candidate);
      break;
    }
    // Nesterov's sequence; started again where the last step went against the gradient (O'Donoghue and Candes, 2015).
    double beta = 0, against = 0;
    for (int i = 0; i < n; ++i) against += share[w.row_slot[i]] * dot(w.point[i] - w.candidate[i], w.candidate[i] - w.traction[i]);
    if (against > 0) {
      momentum = 1;
    } else {
      const double next = 0.5 * (1 + std::sqrt(1 + 4 * momentum * momentum));
      beta = (momentum - 1) / next;
      momentum = next;
    }
    for (int i = 0; i < n; ++i) {
      w.point[i] = w.candidate[i] + beta * (w.candidate[i] - w.traction[i]);
      w.traction[i] = w.candidate[i];
    }
  }

  for (int s = 0; s < sample_count; ++s) {
    w.sample_impulse[s] = {};
    for (int k = first[s]; k < first[s + 1]; ++k) {
      const int i = of_sample[k];
      warm[i] = w.traction[i];
      impulses[i] = share[s] * w.traction[i];
      w.sample_impulse[s] += impulses[i];
    }
  }
  for (int f = 0; f < free_count; ++f) {
    Vec3 sum{};
    for (int k = w.columns.offsets[f]; k < w.columns.offsets[f + 1]; ++k) sum += w.columns.values[k] * w.sample_impulse[w.columns.columns[k]];
    velocity[w.free_points[f]] += inverse_mass[w.free_points[f]] * sum;
  }
  return report;
}

}  // namespace gambeson
