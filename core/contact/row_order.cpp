#include "core/contact/row_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>

#include "core/contact/halving.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

std::span<const int> pointsOf(const ContactWork& w, int row) {
  return std::span(w.reach_point).subspan(static_cast<std::size_t>(w.reach[row].first), w.reach[row].count);
}

/// Of rows of w.order.
struct Range {
  int begin, end;
};
template <class Visit>
void eachPoint(const ContactWork& w, const Range& rows, const Visit& visit) {
  for (int k = rows.begin; k < rows.end; ++k)
    for (int f : pointsOf(w, w.order[k])) visit(f);
}

/// The first number that no rows before have at any of the points of these, which have it from now on; `more`, which
/// goes up, where all are taken.
int takeNumber(const Range& rows, int& more, ContactWork& w) {
  std::array<std::uint64_t, kColours / 64> taken{};
  eachPoint(w, rows, [&](int f) {
    for (std::size_t word = 0; word < taken.size(); ++word) taken[word] |= w.taken[f][word];
  });
  std::size_t word = 0;
  while (word < taken.size() && ~taken[word] == 0) ++word;
  if (word == taken.size()) return more++;
  const int bit = std::countr_one(taken[word]);
  eachPoint(w, rows, [&](int f) { w.taken[f][word] |= std::uint64_t{1} << bit; });
  return 64 * static_cast<int>(word) + bit;
}

/// Gives each row of a chunk a colour and sorts them by it.
void colourChunk(const Range& chunk, ContactWork& w) {
  eachPoint(w, chunk, [&](int f) { w.taken[f] = {}; });
  int more = kColours;
  for (int k = chunk.begin; k < chunk.end; ++k) w.unsorted_colour[k] = takeNumber({k, k + 1}, more, w);
  std::copy(w.order.begin() + chunk.begin, w.order.begin() + chunk.end, w.unsorted.begin() + chunk.begin);
  const auto first = w.number.begin() + chunk.begin, last = w.number.begin() + chunk.end;
  std::iota(first, last, chunk.begin);
  std::stable_sort(first, last, [&](int a, int b) { return w.unsorted_colour[a] < w.unsorted_colour[b]; });
  for (int k = chunk.begin; k < chunk.end; ++k) {
    w.order[k] = w.unsorted[w.number[k]];
    w.colour[k] = w.unsorted_colour[w.number[k]];
  }
}

/// Cuts the rows of a large island into chunks, by phases.
void cutIsland(std::span<const ContactRow> rows, std::span<const int> place, const ContactWork::Island& island,
               ContactWork& w) {
  const auto placeOf = [&](int row) { return place[rows[row].stencil.sample[0]]; };
  const auto first = w.order.begin() + island.row, last = w.order.begin() + island.row_end;
  std::ranges::stable_sort(first, last, {}, placeOf);
  struct Part {
    Range rows;
    int phase;
  };
  std::vector<Part> parts;
  for (int k = island.row; k < island.row_end; k = parts.back().rows.end) {
    Range part{island.row, island.row_end};
    halveAround(
        k, static_cast<int>(place.size()), kWholeIsland, [&](int at) { return placeOf(w.order[at]); }, part.begin,
        part.end);
    parts.push_back({part, 0});
  }
  eachPoint(w, {island.row, island.row_end}, [&](int f) { w.taken[f] = {}; });
  int more = kColours;
  for (Part& part : parts) part.phase = takeNumber(part.rows, more, w);
  std::ranges::stable_sort(parts, {}, &Part::phase);
  std::copy(first, last, w.unsorted.begin() + island.row);
  int row = island.row;
  for (const Part& part : parts) {
    w.chunks.push_back({row, part.phase});
    for (int k = part.rows.begin; k < part.rows.end; ++k) w.order[row++] = w.unsorted[k];
  }
}

}  // namespace

void orderRows(std::span<const ContactRow> rows, std::span<const int> place, int free_count, ContactWork& w) {
  const int n = static_cast<int>(w.order.size());
  w.colour.assign(n, 0);
  w.chunks.clear();
  w.taken.resize(free_count);
  w.number.resize(std::max(free_count, n));
  w.unsorted.resize(n);
  w.unsorted_colour.resize(n);
  for (ContactWork::Island& island : w.islands) {
    island.chunk = static_cast<int>(w.chunks.size());
    if (w.hold || island.row_end - island.row <= kWholeIsland || place.empty())
      w.chunks.push_back({island.row, 0});
    else
      cutIsland(rows, place, island, w);
    island.chunk_end = static_cast<int>(w.chunks.size());
  }
  w.largest2.resize(w.chunks.size());
  w.against.resize(w.chunks.size());
  w.chunks.push_back({n, 0});
  if (w.hold) return;
  // Islands share no point.
  const Each each = n < static_cast<int>(Each::sum) ? Each::value : Each::much;
  forAllUneven(each, static_cast<int>(w.islands.size()), [&](int i) {
    for (int c = w.islands[i].chunk; c < w.islands[i].chunk_end; ++c)
      colourChunk({w.chunks[c].row, w.chunks[c + 1].row}, w);
  });
}

}  // namespace gambeson
