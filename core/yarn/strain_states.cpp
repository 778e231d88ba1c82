#include "core/yarn/strain_states.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr int kLine = 8;  ///< loads that share the scratch of a solution

std::size_t nearestToZero(const std::vector<double>& nodes) {
  const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end(), nearer) - nodes.begin());
}

/// f(work, i) for i < n, in lines; what it throws becomes the failure of i.
void inLines(const RodCell& cell, std::size_t n, std::vector<std::string>& failures,
             const std::function<std::string(EquilibriumWork&, std::size_t)>& f) {
  failures.assign(n, {});
  const int lines = static_cast<int>((n + kLine - 1) / kLine);
  forAllUneven(Each::much, lines, [&](int line) {
    EquilibriumWork work(cell);
    const std::size_t first = static_cast<std::size_t>(line) * kLine;
    for (std::size_t i = first; i < std::min(n, first + kLine); ++i) {
      try {
        failures[i] = f(work, i);
      } catch (const std::exception& e) {
        failures[i] = e.what();
      }
    }
  });
}

}  // namespace

void StrainStates::throwFirst(std::span<const std::string> failures, const std::function<CellLoad(std::size_t)>& load) {
  for (std::size_t i = 0; i < failures.size(); ++i)
    if (!failures[i].empty()) throw NoEquilibrium(load(i), failures[i]);
}

StrainStates::StrainStates(const RodCell& cell, const std::array<std::vector<double>, 3>& nodes,
                           const EquilibriumOptions& options)
    : cell_(cell), options_(options), nodes_(nodes) {
  states_.resize(nodes_[0].size() * nodes_[1].size() * nodes_[2].size());
  const Node origin{nearestToZero(nodes_[0]), nearestToZero(nodes_[1]), nearestToZero(nodes_[2])};
  EquilibriumWork work(cell_);
  CellState rest{{}, {cell_.rest().begin(), cell_.rest().end()}, {}};
  const CellLoad first = loadOf(origin);
  const std::string why =
      findState(cell_, rest, carried(rest.sections, {}, first), first, work, options_, states_[index(origin)]);
  if (!why.empty()) throw NoEquilibrium(first, why);

  goOut(std::vector<Node>{origin}, 2);
  std::vector<Node> known;
  for (std::size_t k = 0; k < nodes_[2].size(); ++k) known.push_back({origin[0], origin[1], k});
  goOut(known, 0);
  known.clear();
  for (std::size_t i = 0; i < nodes_[0].size(); ++i)
    for (std::size_t k = 0; k < nodes_[2].size(); ++k) known.push_back({i, origin[1], k});
  goOut(known, 1);
}

void StrainStates::goOut(std::span<const Node> from, int direction) {
  const std::size_t n = nodes_[direction].size();
  const auto strain = [&](const CellLoad& l) { return direction == 0 ? l.e11 : direction == 1 ? l.e22 : l.g12; };
  std::vector<std::string> failures(states_.size());
  const int lines = 2 * static_cast<int>(from.size());
  forAllUneven(Each::much, lines, [&](int line) {
    const Node& start = from[static_cast<std::size_t>(line / 2)];
    const std::size_t step = line % 2 == 0 ? 1 : static_cast<std::size_t>(-1);  // wraps below 0 to what is not < n
    EquilibriumWork work(cell_);
    std::size_t before = index(start), last = before;
    for (std::size_t at = start[direction] + step; at < n; at += step) {
      Node node = start;
      node[direction] = at;
      const std::size_t here = index(node);
      const CellLoad to = loadOf(node);
      const double part = before == last ? 1
                                         : 1 + (strain(to) - strain(states_[last].load)) /
                                                   (strain(states_[last].load) - strain(states_[before].load));
      try {
        failures[here] = findState(cell_, states_[last], mixed(states_[before], states_[last], part, to), to, work,
                                   options_, states_[here]);
      } catch (const std::exception& e) {
        failures[here] = e.what();
      }
      if (!failures[here].empty()) return;
      before = last, last = here;
    }
  });
  throwFirst(failures, [&](std::size_t i) { return loadOf(nodeOf(i)); });
}

void StrainStates::split(int direction, std::span<const int> intervals) {
  const std::vector<double> old = nodes_[direction];
  std::vector<std::size_t> kept;  // of each old node, its new place
  std::vector<double> nodes;
  std::size_t next = 0;
  for (std::size_t i = 0; i < old.size(); ++i) {
    kept.push_back(nodes.size());
    nodes.push_back(old[i]);
    if (next == intervals.size() || intervals[next] != static_cast<int>(i)) continue;
    nodes.push_back(0.5 * (old[i] + old[i + 1]));
    ++next;
  }
  std::vector<CellState> before = std::move(states_);
  const std::array<std::size_t, 3> was{nodes_[0].size(), nodes_[1].size(), nodes_[2].size()};
  nodes_[direction] = std::move(nodes);
  states_.assign(nodes_[0].size() * nodes_[1].size() * nodes_[2].size(), {});
  std::vector<Node> fresh;
  for (std::size_t m = 0; m < before.size(); ++m) {
    Node node{m / (was[1] * was[2]), m / was[2] % was[1], m % was[2]};
    const std::size_t i = node[direction];
    node[direction] = kept[i];
    states_[index(node)] = std::move(before[m]);
    if (std::find(intervals.begin(), intervals.end(), static_cast<int>(i)) == intervals.end()) continue;
    ++node[direction];
    fresh.push_back(node);
  }
  std::vector<std::string> failures;
  inLines(cell_, fresh.size(), failures, [&](EquilibriumWork& work, std::size_t m) {
    Node a = fresh[m], b = fresh[m];
    --a[direction], ++b[direction];
    const CellState &low = states_[index(a)], &high = states_[index(b)];
    const CellLoad to = loadOf(fresh[m]);
    return findState(cell_, low, mixed(low, high, 0.5, to), to, work, options_, states_[index(fresh[m])]);
  });
  throwFirst(failures, [&](std::size_t m) { return loadOf(fresh[m]); });
}

CellLoad StrainStates::loadAt(const Between& place) const {
  const std::vector<double>& along = nodes_[place.direction];
  const std::size_t i = place.node[place.direction];
  CellLoad load = loadOf(place.node);
  (place.direction == 0   ? load.e11
   : place.direction == 1 ? load.e22
                          : load.g12) += place.part * (along[i + 1] - along[i]);
  return load;
}

std::vector<CellResultants> StrainStates::answersAt(std::span<const Between> places) const {
  std::vector<CellResultants> out(places.size());
  std::vector<std::string> failures;
  inLines(cell_, places.size(), failures, [&](EquilibriumWork& work, std::size_t m) {
    const Between& place = places[m];
    Node next = place.node;
    ++next[place.direction];
    const CellState &low = states_[index(place.node)], &high = states_[index(next)];
    const CellLoad to = loadAt(place);
    CellState found;
    const std::string why = findState(cell_, low, mixed(low, high, place.part, to), to, work, options_, found);
    out[m] = found.resultants;
    return why;
  });
  throwFirst(failures, [&](std::size_t m) { return loadAt(places[m]); });
  return out;
}

}  // namespace gambeson
