#include "core/contact/held_iteration.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/iteration_lanes.hpp"

namespace gambeson {
namespace {

/// point = candidate + beta (candidate - previous), candidate becomes previous. The mark of a row that has carried
/// something stays until the sequence starts again: the bound, and with it the length of the steps, then follows the
/// rows that carry something now.
GAMBESON_WIDE void extrapolate(ContactWork& w, double beta) {
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    const V4 c = quad(w.candidate[k]);
    V4 next = c + beta * (c - quad(w.previous[k]));
    next[3] = beta == 0 ? (c[0] != 0 || c[1] != 0 || c[2] != 0 ? 1.0 : 0.0) : c[3];
    quad(w.previous[k]) = c;
    quad(w.point[k]) = next;
  }
}

/// Adds a vector with a weight, and in the last lane with its size.
inline void addWeighted(double weight, const Quad& q, V4& sum) {
  const double size = std::abs(weight);
  sum += V4{weight, weight, weight, size} * quad(q);
}

/// What the points of the rows, w.point, make the free points do.
GAMBESON_WIDE void movePoints(ContactWork& w) {
  for (std::size_t f = 0; f < w.free_points.size(); ++f) {
    V4 sum{};
    for (int e = w.columns.offsets[f]; e < w.columns.offsets[f + 1]; ++e) {
      const int row = w.columns.columns[e];
      addWeighted(w.row_area[row] * w.columns.values[e], w.point[row], sum);
    }
    quad(w.moved[f]) = quad(w.base[f]) + w.inverse_mass[f] * sum;
  }
}

/// What the rows of an island do to its free points before something holds these, w.change.
GAMBESON_WIDE void changePoints(const std::vector<Quad>& tractions, const ContactWork::Island& island, ContactWork& w) {
  w.change.assign(w.free_points.size(), Vec3{});
  for (int f = island.free_point; f < island.free_end; ++f) {
    V4 sum{};
    for (int e = w.columns.offsets[f]; e < w.columns.offsets[f + 1]; ++e) {
      const int row = w.columns.columns[e];
      sum += (w.row_area[row] * w.columns.values[e]) * quad(tractions[row]);
    }
    w.change[f] = w.inverse_mass[f] * Vec3{sum[0], sum[1], sum[2]};
  }
}

/// Relative velocity of a row, and its bound.
inline void relative(const ContactWork& w, int row, V4& v) {
  v = V4{};
  for (int e = w.points.offsets[row]; e < w.points.offsets[row + 1]; ++e)
    addWeighted(w.points.values[e], w.moved[w.points.columns[e]], v);
}

/// One projected step of the rows from `point` to `candidate`. Returns the largest squared residual; sets the product
/// that tells whether the last step went against the gradient.
GAMBESON_WIDE double stepRows(ContactWork& w, double& against_out) {
  double largest2 = 0, against = 0;
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    V4 v;
    relative(w, static_cast<int>(k), v);
    const ContactWork::Row& facts = w.facts[k];
    const double bound = v[3] + facts.compliance, mark = w.point[k].lane[3];
    // A row without a mark is not in the bound yet.
    const double inverse =
        mark > 0 && bound < facts.largest ? std::max(bound, 0.05 * facts.largest) : facts.largest;  // of the step
    const Vec3 from = vec(w.point[k]);
    const Vec3 next = projected(from - (1 / inverse) * missing({v[0], v[1], v[2]}, from, facts), facts);
    const Vec3 way = next - from;
    largest2 = std::max(largest2, norm2(way) * (inverse * inverse));
    against -= w.row_area[k] * inverse * dot(way, next - vec(w.previous[k]));
    w.candidate[k] = quadOf(next, mark > 0 || !(next == Vec3{}) ? 1.0 : 0.0);
  }
  against_out = against;
  return largest2;
}

/// The largest squared residual of w.point.
GAMBESON_WIDE double residual2OfPoint(const ContactWork& w) {
  double largest2 = 0;
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    V4 v;
    relative(w, static_cast<int>(k), v);
    largest2 = std::max(largest2, residual2({v[0], v[1], v[2]}, vec(w.point[k]), w.facts[k]));
  }
  return largest2;
}

}  // namespace

void holdPoints(ContactWork& w) {
  if (!w.hold) return;
  w.change.resize(w.free_points.size());
  for (std::size_t f = 0; f < w.free_points.size(); ++f) w.change[f] = vec(w.moved[f]) - vec(w.base[f]);
  w.hold->holdTouched(w.change);
  for (std::size_t f = 0; f < w.free_points.size(); ++f)
    w.moved[f] = quadOf(vec(w.base[f]) + w.change[f], w.moved[f].lane[3]);
}

void moveHeld(const std::vector<Quad>& tractions, const ContactWork::Island& island, ContactWork& w,
              std::vector<Quad>& moved) {
  changePoints(tractions, island, w);
  w.hold->holdTouched(w.change);
  for (int f = island.free_point; f < island.free_end; ++f) moved[f] = quadOf(vec(w.base[f]) + w.change[f]);
}

void iterateHeld(double goal, int last, ContactWork& w) {
  for (ContactWork::Island& now : w.islands)
    for (; now.iterations < last && !now.done; ++now.iterations) {
      extrapolate(w, now.beta);
      movePoints(w);
      holdPoints(w);
      double against = 0;
      now.residual_m_per_s = std::sqrt(stepRows(w, against));
      if (now.residual_m_per_s <= goal || now.iterations + 1 == last) {
        // Longer steps than rho show a residual that is too small where the cone cuts it.
        now.residual_m_per_s = std::sqrt(residual2OfPoint(w));
        now.done = now.residual_m_per_s <= goal;
      }
      advance(against, now);
    }
}

void largestBounds(ContactWork& w) {
  for (Quad& point : w.point) point = {{0, 0, 0, 1}};
  movePoints(w);
  for (std::size_t k = 0; k < w.order.size(); ++k) {
    V4 v;
    relative(w, static_cast<int>(k), v);
    w.facts[k].largest = std::max(w.facts[k].slope, v[3] + w.facts[k].compliance);
  }
}

}  // namespace gambeson
