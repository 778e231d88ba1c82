#pragma once
/// Lists that threads make together, in the order in which one alone would.

#include <omp.h>

#include <algorithm>
#include <vector>

namespace gambeson {

/// Calls append(first, end, list) for consecutive ranges of [0, n) and joins the lists in the order of the ranges. From
/// `many` on threads share the work. Nothing may depend on how the ranges are cut.
template <class T, class Append>
void appendInOrder(int n, int many, std::vector<T>& out, Append&& append) {
  constexpr int kParts = 8;  ///< for each thread
  const int threads = n < many ? 1 : omp_get_max_threads();
  if (threads == 1) {
    append(0, n, out);
    return;
  }
  const int parts = kParts * threads;
  static thread_local std::vector<std::vector<T>> kept;  // for its memory
  std::vector<std::vector<T>>& lists = kept;
  if (static_cast<int>(lists.size()) < parts) lists.resize(parts);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (int k = 0; k < parts; ++k) {
    lists[k].clear();
    append(static_cast<int>(static_cast<long>(n) * k / parts), static_cast<int>(static_cast<long>(n) * (k + 1) / parts),
           lists[k]);
  }
  std::size_t size = out.size();
  for (int k = 0; k < parts; ++k) size += lists[k].size();
  out.reserve(size);
  for (int k = 0; k < parts; ++k) out.insert(out.end(), lists[k].begin(), lists[k].end());
}

}  // namespace gambeson
