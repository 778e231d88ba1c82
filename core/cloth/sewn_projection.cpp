#include "core/cloth/sewn_projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gambeson {
namespace {

/// Of a row's own mobility, what the rows that are kept must leave of it.
constexpr double kDependent = 1e-6;

/// C W C^T.
SymmetricMatrix mobilityOf(const SparseRows& C, const SparseRows& Ct, std::span<const double> inverse_mass) {
  SymmetricMatrix S;
  S.size = C.rows();
  std::vector<double> column(static_cast<std::size_t>(C.rows()), 0.0);
  std::vector<int> touched;
  std::vector<char> is_touched(column.size(), 0);
  for (int r = 0; r < C.rows(); ++r) {
    touched.assign(1, r);
    is_touched[r] = 1;
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) {
      const int i = C.columns[k];
      for (int e = Ct.offsets[i]; e < Ct.offsets[i + 1]; ++e) {
        const int other = Ct.columns[e];
        if (other < r) continue;
        if (!std::exchange(is_touched[other], 1)) touched.push_back(other);
        column[other] += C.values[k] * inverse_mass[i] * Ct.values[e];
      }
    }
    std::sort(touched.begin(), touched.end());
    for (const int other : touched) {
      S.rows.push_back(other);
      S.values.push_back(std::exchange(column[other], 0.0));
      is_touched[other] = 0;
    }
    S.offsets.push_back(static_cast<int>(S.rows.size()));
  }
  return S;
}

/// Empties rows that nearly follow from others: Cholesky with the largest pivot first (of what each row has left of its
/// own) tells them. Where sides are straight or their cells match there are more hats than both sides can follow, and a
/// factor in any other order would keep rows that hardly differ, and lose its digits to them.
void dropDependent(SymmetricMatrix& S) {
  const auto n = static_cast<std::size_t>(S.size);
  std::vector<double> left(n, 0.0), own(n, 0.0), full(n * n, 0.0);
  for (std::size_t c = 0; c < n; ++c)
    for (int k = S.offsets[c]; k < S.offsets[c + 1]; ++k) {
      const auto r = static_cast<std::size_t>(S.rows[k]);
      full[r * n + c] = full[c * n + r] = S.values[k];
      if (r == c) left[c] = own[c] = S.values[k];
    }
  std::vector<std::vector<double>> columns;  // of the factor
  std::vector<char> kept(n, 0);
  for (;;) {
    std::size_t best = n;
    double most = kDependent;
    for (std::size_t i = 0; i < n; ++i)
      if (!kept[i] && own[i] > 0 && left[i] > most * own[i]) most = left[i] / own[i], best = i;
    if (best == n) break;
    kept[best] = 1;
    std::vector<double> column(n);
    const double root = std::sqrt(left[best]);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = full[i * n + best];
      for (const std::vector<double>& c : columns) sum -= c[i] * c[best];
      column[i] = kept[i] && i != best ? 0 : sum / root;
      if (!kept[i]) left[i] -= column[i] * column[i];
    }
    columns.push_back(std::move(column));
  }
  for (std::size_t c = 0; c < n; ++c)
    for (int k = S.offsets[c]; k < S.offsets[c + 1]; ++k)
      if (!kept[c] || !kept[static_cast<std::size_t>(S.rows[k])]) S.values[k] = 0;
}

}  // namespace

SewnProjection::SewnProjection(SparseRows C, std::vector<double> inverse_mass)
    : C_(std::move(C)), inverse_mass_(std::move(inverse_mass)) {
  const SparseRows whole = transpose(C_);
  SymmetricMatrix S = mobilityOf(C_, whole, inverse_mass_);
  dropDependent(S);
  factor_ = EnvelopeFactor(S);
  Ct_.column_count = C_.rows();
  for (int i = 0; i < whole.rows(); ++i) {
    if (whole.offsets[i] == whole.offsets[i + 1]) continue;
    points_.push_back(i);
    for (int k = whole.offsets[i]; k < whole.offsets[i + 1]; ++k) Ct_.add(whole.columns[k], whole.values[k]);
    Ct_.endRow();
  }
}

SparseRows SewnProjection::ties(double least) const {
  SparseRows H;
  H.column_count = C_.column_count;
  std::vector<Vec3> lambda(static_cast<std::size_t>(rows())), moved(points_.size()), scratch;
  const auto root = [&](std::size_t k) { return std::sqrt(inverse_mass_[points_[k]]); };
  for (std::size_t first = 0; first < points_.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, points_.size() - first);  // columns, solved side by side
    std::fill(lambda.begin(), lambda.end(), Vec3{});
    for (std::size_t c = 0; c < count; ++c)
      for (int e = Ct_.offsets[first + c]; e < Ct_.offsets[first + c + 1]; ++e)
        lambda[Ct_.columns[e]][static_cast<int>(c)] += Ct_.values[e] * inverse_mass_[points_[first + c]];
    factor_.solve(lambda, scratch);
    Ct_.multiply<Vec3>(lambda, moved);
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t k = 0; k < points_.size(); ++k) {
        const double value = inverse_mass_[points_[k]] * moved[k][static_cast<int>(c)];
        if (std::abs(value) > least * root(k) * root(first + c)) H.add(points_[k], value);
      }
      H.endRow();
    }
  }
  return H;
}

void SewnProjection::gaps(std::span<const Vec3> x, std::vector<Vec3>& g) const {
  g.resize(static_cast<std::size_t>(rows()));
  C_.multiply<Vec3>(x, g);
}

void SewnProjection::takeOff(std::span<Vec3> v, std::span<Vec3> impulse, std::span<const char> open, Work& w) const {
  for (std::size_t k = 0; k < open.size(); ++k)
    if (open[k]) w.lambda[k] = {};
  factor_.solve(w.lambda, w.factor);
  w.moved.resize(points_.size());
  Ct_.multiply<Vec3>(w.lambda, w.moved);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const int i = points_[k];
    v[i] -= inverse_mass_[i] * w.moved[k];
    if (!impulse.empty()) impulse[i] -= w.moved[k];
  }
}

void SewnProjection::project(std::span<Vec3> v, std::span<const Vec3> rates, std::span<Vec3> impulse,
                             std::span<const char> open, Work& w) const {
  for (int pass = 0; pass < 2; ++pass) {
    gaps(v, w.lambda);
    for (std::size_t k = 0; k < rates.size(); ++k) w.lambda[k] -= rates[k];
    takeOff(v, impulse, open, w);
  }
}

void SewnProjection::hold(std::span<Vec3> change, std::span<const char> open, Work& w) const {
  gaps(change, w.lambda);
  takeOff(change, {}, open, w);
}

std::vector<Vec3> closeSeams(const SewnRows& rows, std::span<const double> weight, std::span<const Vec3> q) {
  std::vector<double> inverse;
  for (const double w : weight) inverse.push_back(1 / w);
  std::vector<Vec3> out(q.begin(), q.end());
  SewnProjection::Work work;
  SewnProjection(rows.C, std::move(inverse)).project(out, {}, {}, work);
  return out;
}

}  // namespace gambeson
