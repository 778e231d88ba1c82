#include "core/math/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gambeson {
namespace {

/// Reverse Cuthill-McKee: neighbours stand close to each other.
std::vector<int> narrowOrder(const std::vector<std::vector<int>>& neighbours) {
  const int n = static_cast<int>(neighbours.size());
  std::vector<int> by_degree(static_cast<std::size_t>(n)), order;
  std::iota(by_degree.begin(), by_degree.end(), 0);
  const auto fewer = [&](int a, int b) { return neighbours[a].size() < neighbours[b].size(); };
  std::stable_sort(by_degree.begin(), by_degree.end(), fewer);
  std::vector<char> taken(static_cast<std::size_t>(n), 0);
  for (const int start : by_degree) {
    if (taken[start]) continue;
    taken[start] = 1;
    order.push_back(start);
    for (std::size_t at = order.size() - 1; at < order.size(); ++at) {
      std::vector<int> next;
      for (const int k : neighbours[order[at]])
        if (!taken[k]) taken[k] = 1, next.push_back(k);
      std::stable_sort(next.begin(), next.end(), fewer);
      order.insert(order.end(), next.begin(), next.end());
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

EnvelopeFactor::EnvelopeFactor(const SymmetricMatrix& K, double dependent) {
  const int n = K.size;
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(n));
  for (int c = 0; c < n; ++c)
    for (int k = K.offsets[c]; k < K.offsets[c + 1]; ++k)
      if (const int r = K.rows[k]; r != c) neighbours[c].push_back(r), neighbours[r].push_back(c);
  for (std::vector<int>& list : neighbours) std::sort(list.begin(), list.end());
  order_ = narrowOrder(neighbours);
  std::vector<int> place(order_.size());
  for (int i = 0; i < n; ++i) place[order_[i]] = i;
  offsets_.push_back(0);
  for (int i = 0; i < n; ++i) {
    int first = i;
    for (const int k : neighbours[order_[i]]) first = std::min(first, place[k]);
    first_.push_back(first);
    offsets_.push_back(offsets_.back() + i - first + 1);
  }
  values_.assign(static_cast<std::size_t>(offsets_.back()), 0.0);
  const auto at = [&](int r, int c) -> double& { return values_[offsets_[r] + c - first_[r]]; };
  for (int c = 0; c < n; ++c)
    for (int k = K.offsets[c]; k < K.offsets[c + 1]; ++k)
      at(std::max(place[c], place[K.rows[k]]), std::min(place[c], place[K.rows[k]])) = K.values[k];
  for (int r = 0; r < n; ++r) {
    const double diagonal = at(r, r);
    for (int c = first_[r]; c <= r; ++c) {
      double sum = at(r, c);
      for (int k = std::max(first_[r], first_[c]); k < c; ++k) sum -= at(r, k) * at(c, k);
      if (c < r) {
        const double pivot = at(c, c);
        at(r, c) = pivot > 0 ? sum / pivot : 0;
      } else {
        const bool stands = sum > dependent * diagonal;
        if (!stands) {
          ++left_out_;
          for (int k = first_[r]; k < r; ++k) at(r, k) = 0;
        }
        at(r, r) = stands ? std::sqrt(sum) : 0;
      }
    }
  }
}

void EnvelopeFactor::solve(std::span<Vec3> x, std::vector<Vec3>& y) const {
  const int n = size();
  y.resize(static_cast<std::size_t>(n));
  for (int r = 0; r < n; ++r) {
    const double* row = values_.data() + offsets_[r] - first_[r];
    Vec3 sum = x[order_[r]];
    for (int c = first_[r]; c < r; ++c) sum -= row[c] * y[c];
    y[r] = row[r] > 0 ? sum / row[r] : Vec3{};
  }
  for (int r = n - 1; r >= 0; --r) {
    const double* row = values_.data() + offsets_[r] - first_[r];
    y[r] = row[r] > 0 ? y[r] / row[r] : Vec3{};
    for (int c = first_[r]; c < r; ++c) y[c] -= row[c] * y[r];
  }
  for (int r = 0; r < n; ++r) x[order_[r]] = y[r];
}

}  // namespace gambeson
