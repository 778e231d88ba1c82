#include "core/solid/tangent_solver.hpp"

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <mutex>

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

/// Whose turn it is with BLAS.
std::mutex& blas() {
  static std::mutex mutex;
  return mutex;
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

struct TangentSolver::Unsymmetric {
  Sparse K;
  Eigen::SparseLU<Sparse> factor;
};

TangentSolver::TangentSolver() = default;
TangentSolver::~TangentSolver() = default;

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

bool TangentSolver::factorise(std::span<const MatrixEntry> entries, int size, bool symmetric, double raise) {
  negative_ = 0;
  unsymmetric_.reset();
  if (!std::all_of(entries.begin(), entries.end(), [](const MatrixEntry& e) { return std::isfinite(e.value); }))
    return false;
  ++factors_;
  if (!symmetric) {
    unsymmetric_ = std::make_unique<Unsymmetric>();
    unsymmetric_->K = matrixOf(entries, size, false);
    unsymmetric_->factor.compute(unsymmetric_->K);
    return unsymmetric_->factor.info() == Eigen::Success;
  }
  SymmetricMatrix lower = lowerTriangle(entries, size);
  for (int j = 0; j < size; ++j) lower.values[lower.offsets[j]] += raise * std::abs(lower.values[lower.offsets[j]]);
  if (!fits(lower)) {
    ++analyses_;
    kept_ = std::move(lower);
    factor_ = std::make_unique<SymmetricFactor>(kept_);
  }
  const std::lock_guard<std::mutex> turn(blas());
  const Definiteness found = factor_->factorise(kept_);
  negative_ = factor_->negativePivots();
  return found != Definiteness::singular;
}

void TangentSolver::solve(std::span<const double> b, std::span<double> x) const {
  if (unsymmetric_) {
    const Eigen::Map<const Vector> right(b.data(), static_cast<Eigen::Index>(b.size()));
    Vector v = unsymmetric_->factor.solve(right);
    v += unsymmetric_->factor.solve(Vector(right - unsymmetric_->K * v));
    std::copy(v.data(), v.data() + v.size(), x.begin());
    return;
  }
  const std::lock_guard<std::mutex> turn(blas());
  factor_->solve(b, x);
}

}  // namespace gambeson
