#pragma once
/// The one place where threads start: loops that share their work, and what they make together in a fixed order. The
/// contact solve alone keeps a team of its own (core/contact/contact_iteration.cpp).

#include <omp.h>

#include <algorithm>
#include <vector>

namespace gambeson {

/// What one turn of a loop costs, as the number of turns from which on waking threads pays (some 10 us of one thread).
enum class Each : int {
  value = 4096,  ///< a few operations
  sum = 512,     ///< a sum over a few neighbours, a pair of features
  element = 16,  ///< a group of cells or hinges in lanes, a spring of a seam
  much = 2,      ///< a query, a block of vertices
};

/// f(i) for begin <= i < end, in any order and side by side; it writes to places of its own.
template <class Index, class F>
void forAll(Each each, Index begin, Index end, F&& f) {
#pragma omp parallel for schedule(static) if (end - begin >= static_cast <int>(each))
  for (Index i = begin; i < end; ++i) f(i);
}
template <class Index, class F>
void forAll(Each each, Index n, F&& f) {
  forAll(each, Index{0}, n, f);
}

/// The same where turns cost unlike much: whoever is free takes the next.
template <class F>
void forAllUneven(Each each, int n, F&& f) {
#pragma omp parallel for schedule(dynamic) if (n >= static_cast <int>(each))
  for (int i = 0; i < n; ++i) f(i);
}

/// f(scratch, i), with a scratch for each thread.
template <class Scratch, class F>
void forAllWith(Each each, int begin, int end, F&& f) {
#pragma omp parallel if (end - begin >= static_cast <int>(each))
  {
    Scratch scratch{};
#pragma omp for schedule(static)
    for (int i = begin; i < end; ++i) f(scratch, i);
  }
}

/// f(mine, me, k) for k < n by a team of so many threads: whoever is free takes the next. `mine` is what begin(me) made
/// for the thread `me`.
template <class Begin, class F>
void forAllInTeam(int threads, int n, Begin&& begin, F&& f) {
#pragma omp parallel num_threads(threads)
  {
    const int me = omp_get_thread_num();
    auto mine = begin(me);
#pragma omp for schedule(dynamic)
    for (int k = 0; k < n; ++k) f(mine, me, k);
  }
}

/// join(join(start, f(0)), f(1)) ...: of what does not depend on the order (counts, largest values). Each thread begins
/// with `start`, which must change nothing when it is joined once more.
template <class T, class F, class Join>
T joined(Each each, int n, T start, F&& f, Join&& join) {
  const int threads = n < static_cast<int>(each) ? 1 : omp_get_max_threads();
  std::vector<T> parts(static_cast<std::size_t>(threads), start);
  forAll(Each::much, threads, [&](int k) {
    T part = start;
    const int end = static_cast<int>(static_cast<long>(n) * (k + 1) / threads);
    for (int i = static_cast<int>(static_cast<long>(n) * k / threads); i < end; ++i) part = join(part, f(i));
    parts[static_cast<std::size_t>(k)] = part;
  });
  T all = start;
  for (const T& part : parts) all = join(all, part);
  return all;
}
template <class T, class F>
T largestOf(Each each, int n, T least, F&& f) {
  return joined(each, n, least, f, [](const T& a, const T& b) { return std::max(a, b); });
}
/// How many i have f(i).
template <class F>
int countOf(Each each, int n, F&& f) {
  return joined(
      each, n, 0, [&](int i) { return static_cast<int>(f(i)); }, [](int a, int b) { return a + b; });
}

/// Calls append(first, end, list) for consecutive ranges of [0, n) and joins the lists in the order of the ranges.
/// Nothing may depend on how the ranges are cut.
template <class T, class Append>
void appendInOrder(int n, Each each, std::vector<T>& out, Append&& append) {
  constexpr int kParts = 8;  ///< for each thread
  const int threads = n < static_cast<int>(each) ? 1 : omp_get_max_threads();
  if (threads == 1) {
    append(0, n, out);
    return;
  }
  const int parts = kParts * threads;
  static thread_local std::vector<std::vector<T>> kept;  // for its memory
  std::vector<std::vector<T>>& lists = kept;
  if (static_cast<int>(lists.size()) < parts) lists.resize(static_cast<std::size_t>(parts));
  forAllUneven(Each::much, parts, [&](int k) {
    std::vector<T>& list = lists[static_cast<std::size_t>(k)];
    list.clear();
    append(static_cast<int>(static_cast<long>(n) * k / parts), static_cast<int>(static_cast<long>(n) * (k + 1) / parts),
           list);
  });
  std::size_t size = out.size();
  for (int k = 0; k < parts; ++k) size += lists[static_cast<std::size_t>(k)].size();
  out.reserve(size);
  for (int k = 0; k < parts; ++k) {
    const std::vector<T>& list = lists[static_cast<std::size_t>(k)];
    out.insert(out.end(), list.begin(), list.end());
  }
}

}  // namespace gambeson
