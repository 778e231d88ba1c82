#include "core/motion/sewing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gambeson {
namespace {

std::size_t garmentsOf(const Model& m) {
  return static_cast<std::size_t>(*std::max_element(m.sewn_garment.begin(), m.sewn_garment.end())) + 1;
}

bool rubs(const std::optional<FrictionLaw>& law) { return law && *law != FrictionLaw{}; }
bool rubs(const ContactParameters& c) {
  return rubs(std::optional(c.friction)) || rubs(c.on_cloth) ||
         std::any_of(c.of_obstacle.begin(), c.of_obstacle.end(), [](const auto& law) { return rubs(law); }) ||
         std::any_of(c.of_garment.begin(), c.of_garment.end(), [](const auto& law) { return rubs(law); });
}

}  // namespace

void closingRates(const Model& m, std::span<const Vec3> p, double dt, StepScratch& w) {
  m.sewing.gaps(p, w.sewn_rates);
  std::vector<double> rate(garmentsOf(m), 0.0);  // first the widest gap
  for (std::size_t k = 0; k < w.sewn_rates.size(); ++k) {
    double& widest = rate[static_cast<std::size_t>(m.sewn_garment[k])];
    widest = std::max(widest, norm(w.sewn_rates[k]));
  }
  for (double& r : rate) {
    const double widest = r;
    r = std::min(m.sewing_options.close_per_s, 1 / dt);
    if (r * widest > m.sewing_options.close_m_per_s) r = m.sewing_options.close_m_per_s / widest;
  }
  for (std::size_t k = 0; k < w.sewn_rates.size(); ++k)
    w.sewn_rates[k] *= -rate[static_cast<std::size_t>(m.sewn_garment[k])];
}

void findOpenSeams(const Model& m, StepScratch& w) {
  const double fast = (1 - 1e-9) * m.sewing_options.close_m_per_s;
  std::vector<char> open(garmentsOf(m), 0);
  const bool rub = rubs(m.contact);
  for (std::size_t k = 0; k < w.sewn_rates.size(); ++k)
    if (rub && norm(w.sewn_rates[k]) >= fast) open[static_cast<std::size_t>(m.sewn_garment[k])] = 1;
  w.sewn_open.clear();
  for (const int garment : m.sewn_garment) w.sewn_open.push_back(open[static_cast<std::size_t>(garment)]);
}

bool someSeamsHold(const StepScratch& w) {
  return std::any_of(w.sewn_open.begin(), w.sewn_open.end(), [](char open) { return !open; });
}

void sewVelocities(const Model& m, std::span<const Vec3> p, double dt, StepWork& w) {
  w.sewn_closing.assign(static_cast<std::size_t>(m.freeCount()), Vec3{});
  closingRates(m, p, dt, w);
  findOpenSeams(m, w);
  m.sewing.project(w.predictor, w.sewn_rates, w.sewn_closing, w.sewn);
}

// With f = - C^T lambda of the projection in the metric of M, (1 + h c) f is nearly that of M + h D, c the mean of d/m
// on the seams' points; where all points have one d/m it is that, and else each turn leaves h (c - d/m) of the rest.
std::span<const Vec3> sewAccelerations(const Model& m, double h, std::span<Vec3> a, StepScratch& w) {
  const std::vector<int>& points = m.sewing.points();
  w.sewn_force.assign(a.size(), Vec3{});
  double mean = 0;
  for (const int i : points) mean += m.drag_kg_per_s[i] / m.mass_kg[i] / static_cast<double>(points.size());
  std::vector<Vec3>& right = w.sewn_right;  // M times what a misses
  right.assign(a.size(), Vec3{});
  constexpr int kMostTurns = 8;
  double first = 0;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    std::vector<Vec3>& part = w.sewn_part;
    part.assign(a.size(), Vec3{});
    m.sewing.project(a, {}, part, w.sewn);
    double left = 0;
    for (const int i : points) {
      const double d = m.drag_kg_per_s[i];
      w.sewn_force[i] += (1 + h * mean) * part[i];
      right[i] += (h * (mean - d / m.mass_kg[i])) * part[i];
      if (m.inverse_mass[i] == 0) continue;
      left = std::max(left, norm(right[i]));
      if (turn == 0) first = std::max(first, norm(part[i]));
    }
    if (!(left > 1e-14 * first)) break;
    for (const int i : points) {
      if (m.inverse_mass[i] > 0) {
        const double b = m.mass_kg[i] + h * m.drag_kg_per_s[i];
        a[i] += right[i] / b;
      }
      right[i] = {};
    }
  }
  return w.sewn_force;
}

void addSeamsUnderContact(const Model& m, std::span<const Vec3> impulses, StepWork& w) {
  w.sewn_part.assign(impulses.begin(), impulses.end());
  for (std::size_t i = 0; i < w.sewn_part.size(); ++i) w.sewn_part[i] *= m.inverse_mass[i];
  m.sewing.project(w.sewn_part, {}, w.sewn_impulse, w.sewn_open, w.sewn);
}

double sewingWork(const Model& m, double dt, std::span<const Vec3> foreseen, std::span<const Vec3> from,
                  std::span<const Vec3> to, const StepWork& w) {
  double work = 0;
  for (const int i : m.sewing.points()) {
    const Vec3& impulse = w.sewn_closing[i];
    work += m.inverse_mass[i] == 0
                ? dot(impulse, to[i] - from[i]) / dt
                : dot(impulse, w.predictor[i] - (0.5 * m.inverse_mass[i]) * impulse - (0.5 * dt) * foreseen[i]);
  }
  return work;
}

double widestGap(const Model& m, std::span<const Vec3> p) {
  std::vector<Vec3> gap(static_cast<std::size_t>(m.sewn_pairs.rows()));
  m.sewn_pairs.multiply<Vec3>(p, gap);
  double widest = 0;
  for (std::size_t k = 0; k < gap.size(); ++k) widest = std::max(widest, norm(gap[k]) / m.sewn_cell_m[k]);
  return widest;
}

void SewnHold::touch(std::span<const int> points) {
  points_.assign(points.begin(), points.end());
  sewn_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (std::binary_search(model_.sewing.points().begin(), model_.sewing.points().end(), points_[k]))
      sewn_.push_back(static_cast<int>(k));
}

void SewnHold::holdTouched(std::span<Vec3> change) const {
  const auto at = [&](int k) -> Vec3& { return all_[static_cast<std::size_t>(points_[static_cast<std::size_t>(k)])]; };
  for (const int i : model_.sewing.points()) all_[static_cast<std::size_t>(i)] = {};
  for (const int k : sewn_) at(k) = change[static_cast<std::size_t>(k)];
  model_.sewing.hold(all_, open_, work_);
  for (const int k : sewn_) change[static_cast<std::size_t>(k)] = at(k);
}

PointTies SewnHold::ties(int i) const {
  const std::vector<int>& points = model_.sewing.points();
  const auto at = std::lower_bound(points.begin(), points.end(), i);
  if (at == points.end() || *at != i) return {};
  const auto k = static_cast<std::size_t>(at - points.begin());
  if (!open_.empty() && open_[static_cast<std::size_t>(model_.sewing.rowOf(k))]) return {};
  const SparseRows& H = model_.sewn_ties;
  const auto begin = static_cast<std::size_t>(H.offsets[k]), count = static_cast<std::size_t>(H.offsets[k + 1]) - begin;
  return {std::span(H.columns).subspan(begin, count), std::span(H.values).subspan(begin, count)};
}

bool contactsMeetSeams(const Model& m, std::span<const ContactRow> rows) {
  const SparseRows& WT = m.surface.WT;
  for (const ContactRow& row : rows)
    for (int k = 0; k < row.stencil.count; ++k)
      for (int e = WT.offsets[row.stencil.sample[k]]; e < WT.offsets[row.stencil.sample[k] + 1]; ++e)
        if (std::binary_search(m.sewing.points().begin(), m.sewing.points().end(), WT.columns[e])) return true;
  return false;
}

}  // namespace gambeson
