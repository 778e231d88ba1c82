#include "core/contact/row_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>

namespace gambeson {
namespace {

constexpr int kPatch = 256;  ///< rows of a patch of a large island

std::span<const int> pointsOf(const ContactWork& w, int row) {
  return std::span(w.reach_point).subspan(static_cast<std::size_t>(w.reach[row].first), w.reach[row].count);
}

/// Gives each row of a patch the first colour that no row before it has at any of its points, what finds all taken one
/// of its own; and sorts them by colours.
void colourPatch(int begin, int end, ContactWork& w) {
  for (int k = begin; k < end; ++k)
    for (int f : pointsOf(w, w.order[k])) w.taken[f] = {};
  int more = kColours;
  for (int k = begin; k < end; ++k) {
    const std::span<const int> points = pointsOf(w, w.order[k]);
    std::array<std::uint64_t, kColours / 64> taken{};
    for (int f : points)
      for (std::size_t word = 0; word < taken.size(); ++word) taken[word] |= w.taken[f][word];
    std::size_t word = 0;
    while (word < taken.size() && ~taken[word] == 0) ++word;
    if (word == taken.size()) {
      w.unsorted_colour[k] = more++;
      continue;
    }
    const int bit = std::countr_one(taken[word]);
    w.unsorted_colour[k] = 64 * static_cast<int>(word) + bit;
    for (int f : points) w.taken[f][word] |= std::uint64_t{1} << bit;
  }
  std::copy(w.order.begin() + begin, w.order.begin() + end, w.unsorted.begin() + begin);
  const auto first = w.number.begin() + begin, last = w.number.begin() + end;
  std::iota(first, last, begin);
  std::stable_sort(first, last, [&](int a, int b) { return w.unsorted_colour[a] < w.unsorted_colour[b]; });
  for (int k = begin; k < end; ++k) {
    w.order[k] = w.unsorted[w.number[k]];
    w.colour[k] = w.unsorted_colour[w.number[k]];
  }
}

/// Cuts the rows of a large island into patches, phase by phase. A patch grows from the first row that no patch has, by
/// the rows around, nearest first, and passes over rows that another patch of the phase shares a point with: these wait
/// for the next phase.
class Patches {
 public:
  Patches(const ContactWork::Island& island, ContactWork& work) : w_(work) {
    rows_.assign(w_.order.begin() + island.row, w_.order.begin() + island.row_end);
    int at = island.row;
    for (int phase = 0; !rows_.empty(); ++phase) {
      listRowsOfPoints();
      state_.assign(rows_.size(), State::free);
      for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
        const int begin = at;
        if (state_[i] == State::free) grow(i, begin, at);
        if (at > begin) w_.chunks.push_back({begin, phase});
      }
      std::size_t left = 0;
      for (std::size_t i = 0; i < rows_.size(); ++i)
        if (state_[i] != State::taken) rows_[left++] = rows_[i];
      rows_.resize(left);
    }
  }

 private:
  enum class State : char { free, queued, taken, waits };

  /// The rows left at each of their points: of_point_[first_[p], first_[p + 1]), p the number of the point.
  void listRowsOfPoints() {
    points_ = 0;
    const auto each = [&](const auto& visit) {
      for (int i = 0; i < static_cast<int>(rows_.size()); ++i)
        for (int f : pointsOf(w_, rows_[i])) visit(f, i);
    };
    each([&](int f, int) { w_.number[f] = -1; });
    each([&](int f, int) {
      if (w_.number[f] < 0) w_.number[f] = points_++;
    });
    first_.assign(points_ + 1, 0);
    each([&](int f, int) { ++first_[w_.number[f] + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    of_point_.resize(first_[points_]);
    next_ = first_;
    each([&](int f, int i) { of_point_[next_[w_.number[f]]++] = i; });
    owner_.assign(points_, -1);
  }

  void grow(int seed, int patch, int& at) {
    queue_.assign(1, seed);
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      const int i = queue_[k];
      const std::span<const int> points = pointsOf(w_, rows_[i]);
      const auto others = [&](int f) { return owner_[w_.number[f]] >= 0 && owner_[w_.number[f]] != patch; };
      if (at - patch == kPatch) {
        state_[i] = State::free;
      } else if (std::any_of(points.begin(), points.end(), others)) {
        state_[i] = State::waits;
      } else {
        state_[i] = State::taken;
        w_.order[at++] = rows_[i];
        for (int f : points) {
          const int p = w_.number[f];
          if (owner_[p] == patch) continue;
          owner_[p] = patch;
          for (int j = first_[p]; j < first_[p + 1]; ++j)
            if (state_[of_point_[j]] == State::free) {
              state_[of_point_[j]] = State::queued;
              queue_.push_back(of_point_[j]);
            }
        }
      }
    }
  }

  ContactWork& w_;
  std::vector<int> rows_, first_, next_, of_point_, owner_, queue_;
  std::vector<State> state_;
  int points_ = 0;
};

}  // namespace

void orderRows(int free_count, ContactWork& w) {
  const int n = static_cast<int>(w.order.size());
  w.colour.assign(n, 0);
  w.chunks.clear();
  w.taken.resize(free_count);
  w.number.resize(std::max(free_count, n));
  w.unsorted.resize(n);
  w.unsorted_colour.resize(n);
  for (ContactWork::Island& island : w.islands) {
    island.chunk = static_cast<int>(w.chunks.size());
    if (w.hold || island.row_end - island.row <= kWholeIsland)
      w.chunks.push_back({island.row, 0});
    else
      Patches(island, w);
    island.chunk_end = static_cast<int>(w.chunks.size());
  }
  w.largest2.resize(w.chunks.size());
  w.against.resize(w.chunks.size());
  w.chunks.push_back({n, 0});
  if (w.hold) return;
  for (std::size_t c = 0; c + 1 < w.chunks.size(); ++c) colourPatch(w.chunks[c].row, w.chunks[c + 1].row, w);
}

}  // namespace gambeson
