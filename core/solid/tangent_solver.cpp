#include "core/solid/tangent_solver.hpp"

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

Sparse matrixOf(std::span<const MatrixEntry> entries, int size, bool lower) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry& e : entries)
    if (!lower || e.row >= e.column) triplets.emplace_back(e.row, e.column, e.value);
  Sparse K(size, size);
  K.setFromTriplets(triplets.begin(), triplets.end());
  return K;
}

}  // namespace

SymmetricMatrix lowerTriangle(std::span<const MatrixEntry> entries, int size) {
  const Sparse K = matrixOf(entries, size, true);
  SymmetricMatrix lower;
  lower.size = size;
  lower.offsets.assign(K.outerIndexPtr(), K.outerIndexPtr() + size + 1);
  lower.rows.assign(K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros());
  lower.values.assign(K.valuePtr(), K.valuePtr() + K.nonZeros());
  return lower;
}

bool TangentSolver::fits(const SymmetricMatrix& lower) {
  if (!factor_ || kept_.size != lower.size) return false;
  std::fill(kept_.values.begin(), kept_.values.end(), 0.0);
  for (int c = 0; c < lower.size; ++c) {
    int at = kept_.offsets[c];
    const int end = kept_.offsets[c + 1];
    for (int k = lower.offsets[c]; k < lower.offsets[c + 1]; ++k) {
      while (at < end && kept_.rows[at] < lower.rows[k]) ++at;
      if (at == end || kept_.rows[at] != lower.rows[k]) return false;
      kept_.values[at] = lower.values[k];
    }
  }
  return true;
}

std::optional<std::vector<double>> TangentSolver::solve(std::span<const MatrixEntry> entries, std::span<const double> b,
                                                        bool symmetric, double raise) {
  negative_ = 0;
  if (!std::all_of(entries.begin(), entries.end(), [](const MatrixEntry& e) { return std::isfinite(e.value); }))
    return std::nullopt;
  const int size = static_cast<int>(b.size());
  std::vector<double> x(b.size());
  ++factors_;
  if (symmetric) {
    SymmetricMatrix lower = lowerTriangle(entries, size);
    for (int j = 0; j < size; ++j) lower.values[lower.offsets[j]] += raise * std::abs(lower.values[lower.offsets[j]]);
    if (!fits(lower)) {
      ++analyses_;
      kept_ = std::move(lower);
      factor_ = std::make_unique<SymmetricFactor>(kept_, elimination_);
    }
    if (factor_->factorise(kept_) == Definiteness::singular) return std::nullopt;
    negative_ = factor_->negativePivots();
    factor_->solve(b, x);
    return x;
  }
  ++analyses_;
  const Sparse K = matrixOf(entries, size, false);
  Eigen::SparseLU<Sparse> factor;
  factor.compute(K);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::Map<const Vector> right(b.data(), size);
  Vector v = factor.solve(right);
  v += factor.solve(Vector(right - K * v));
  std::copy(v.data(), v.data() + size, x.begin());
  return x;
}

}  // namespace gambeson
