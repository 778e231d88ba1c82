#include "core/statics/reduction.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

struct Source {
  int row;
  int source;
  double weight;
};

/// Calls visit(column, row, source, weight), column <= row, for each product C(R, a) K(R, S) C(S, b) that counts.
template <class Visit>
void forProducts(const BlockMatrix& K, const SparseRows& C, const Visit& visit) {
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k) {
      const int c = K.columns[k];
      for (int e = 0; e < 9; ++e) {
        const int R = 3 * r + e / 3, S = 3 * c + e % 3;
        const int source = static_cast<int>(9 * k + e);
        for (int i = C.offsets[R]; i < C.offsets[R + 1]; ++i)
          for (int j = C.offsets[S]; j < C.offsets[S + 1]; ++j) {
            const int a = C.columns[i], b = C.columns[j];
            const double w = C.values[i] * C.values[j];
            if (r == c) {  // held whole: its mirror image comes by itself
              if (a >= b) visit(b, a, source, w);
            } else {  // stands for its mirror image too
              visit(std::min(a, b), std::max(a, b), source, a == b ? 2 * w : w);
            }
          }
      }
    }
}

}  // namespace

Reduction::Reduction(const BlockMatrix& K, const SparseRows& C) {
  if (9 * static_cast<long>(K.columns.size()) > std::numeric_limits<int>::max())
    throw InputError({"", 0, "size"}, "too many cells for the solvers");
  const int n = C.column_count;
  std::vector<long> first(n + 1, 0);
  forProducts(K, C, [&](int column, int, int, double) { ++first[column + 1]; });
  for (int c = 0; c < n; ++c) first[c + 1] += first[c];
  std::vector<Source> list(first[n]);
  std::vector<long> next(first.begin(), first.end() - 1);
  forProducts(K, C, [&](int column, int row, int source, double w) { list[next[column]++] = {row, source, w}; });

  sparsity_.size = n;
  offsets_.push_back(0);
  for (int c = 0; c < n; ++c) {
    std::stable_sort(list.begin() + first[c], list.begin() + first[c + 1],
                     [](const Source& a, const Source& b) { return a.row < b.row; });
    for (long k = first[c]; k < first[c + 1]; ++k) {
      if (k == first[c] || list[k].row != list[k - 1].row) {
        if (k > first[c]) offsets_.push_back(k);
        sparsity_.rows.push_back(list[k].row);
      }
      sources_.push_back(list[k].source);
      weights_.push_back(list[k].weight);
    }
    if (first[c + 1] > first[c]) offsets_.push_back(first[c + 1]);
    if (sparsity_.rows.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw InputError({"", 0, "size"}, "too many unknowns for the solvers");
    sparsity_.offsets.push_back(static_cast<int>(sparsity_.rows.size()));
  }
  sparsity_.values.assign(sparsity_.rows.size(), 0.0);
  if (sources_.size() == sparsity_.rows.size()) offsets_ = {};
  if (std::all_of(weights_.begin(), weights_.end(), [](double w) { return w == 1; })) weights_ = {};
}

void Reduction::reduce(const BlockMatrix& K, SymmetricMatrix& out) const {
  out.values.resize(sparsity_.rows.size());
  const long n = static_cast<long>(sparsity_.rows.size());
  forAll(Each::value, n, [&](long e) {
    if (offsets_.empty()) {
      out.values[e] = (weights_.empty() ? 1.0 : weights_[e]) * K.values[sources_[e]];
      return;
    }
    double sum = 0;
    for (long k = offsets_[e]; k < offsets_[e + 1]; ++k)
      sum += (weights_.empty() ? 1.0 : weights_[k]) * K.values[sources_[k]];
    out.values[e] = sum;
  });
}

void multiply(const BlockMatrix& K, std::span<const double> x, std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k) {
      const int c = K.columns[k];
      const double* v = K.values.data() + 9 * k;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          y[3 * r + i] += v[3 * i + j] * x[3 * c + j];
          if (r != c) y[3 * c + j] += v[3 * i + j] * x[3 * r + i];
        }
    }
}

}  // namespace gambeson
