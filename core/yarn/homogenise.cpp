#include "core/yarn/homogenise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/material/table/strain_spline.hpp"
#include "core/math/parallel.hpp"
#include "core/yarn/cell_bending.hpp"

namespace gambeson {
namespace {

using Strain = std::array<double, 3>;
using Nodes = std::array<std::vector<double>, 3>;

constexpr const char* kNames[] = {"e11", "e22", "g12"};

Strain strainOf(const CellLoad& load) { return {load.e11, load.e22, load.g12}; }

void check(const HomogeniseOptions& o) {
  const auto refuse = [](const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); };
  for (int d = 0; d < 3; ++d) {
    const auto [low, high] = o.range[d];
    if (!(low <= 0 && high >= 0 && low < high && std::isfinite(low) && std::isfinite(high)))
      refuse(std::string("range.") + kNames[d], fmt::format("{:.6g} to {:.6g}, must hold 0", low, high));
    if (o.first_nodes[d] < 4 || o.first_nodes[d] > 64)
      refuse("first_nodes", fmt::format("{}, must be 4 to 64", o.first_nodes[d]));
  }
  for (const double e11 : o.range[0])
    for (const double e22 : o.range[1])
      for (const double g12 : o.range[2]) {
        const CellLoad corner{e11, e22, g12, 0, 0};
        try {
          checkLoad(corner);
        } catch (const InputError& e) {
          refuse("range." + e.where().key.substr(e.where().key.find('.') + 1), e.reason());
        }
      }
  const long first = long{o.first_nodes[0]} * o.first_nodes[1] * o.first_nodes[2];
  if (o.most_nodes < first) refuse("most_nodes", fmt::format("{}, must be at least the first {}", o.most_nodes, first));
  if (!(o.tension_error > 0 && o.shear_error > 0))
    refuse("errors", fmt::format("{:.6g} and {:.6g}, must be > 0", o.tension_error, o.shear_error));
}

/// From low over 0 to high, about evenly.
std::vector<double> nodesThroughZero(double low, double high, int count) {
  const int intervals = count - 1;
  int below = static_cast<int>(std::lround(intervals * -low / (high - low)));
  if (low < 0) below = std::max(below, 1);
  if (high > 0) below = std::min(below, intervals - 1);
  std::vector<double> nodes;
  for (int i = 0; i <= intervals; ++i)
    nodes.push_back(i < below    ? low * (below - i) / below
                    : i == below ? 0.0
                                 : high * (i - below) / (intervals - below));
  return nodes;
}

/// First, middle and last of nodes that stay in the grid.
std::array<double, 3> linesThrough(const std::vector<double>& nodes) {
  return {nodes.front(), nodes[nodes.size() / 2], nodes.back()};
}

/// The refinement of a grid.
class Refinement {
 public:
  Refinement(const RodCell& cell, const Nodes& first, bool even, const HomogeniseOptions& options)
      : options_(options), even_(even), states_(cell, first, options.equilibrium) {
    for (int d = 0; d < 3; ++d) lines_[d] = linesThrough(first[d]);
  }

  void run(HomogenisedCell& out) {
    while (true) {
      const StrainSpline<1> spline = splineOf();
      setLargest(out);
      setNodeErrors(spline, out);
      std::array<Along, 3> along;
      for (int d = 0; d < 3; ++d) along[d] = errorsAlong(d, spline, out);
      std::array<double, 3> sum{};
      for (const Along& a : along)
        for (int c = 0; c < 3; ++c) sum[c] += a.greatest[c];
      out.tension_error = std::max(sum[0], sum[1]), out.shear_error = sum[2];
      out.checked = static_cast<int>(answers_.size());
      out.reached = out.tension_error <= options_.tension_error && out.shear_error <= options_.shear_error;
      if (out.reached) return;

      std::array<double, 3> worst{};
      for (int d = 0; d < 3; ++d) worst[d] = *std::max_element(along[d].by_wanted.begin(), along[d].by_wanted.end());
      const int direction = static_cast<int>(std::max_element(worst.begin(), worst.end()) - worst.begin());
      std::vector<int> intervals;
      for (std::size_t i = 0; i < along[direction].by_wanted.size(); ++i)
        if (2 * along[direction].by_wanted[i] >= worst[direction]) intervals.push_back(static_cast<int>(i));
      const std::size_t plane = states_.count() / states_.nodes()[direction].size();
      if (states_.count() + plane * intervals.size() > static_cast<std::size_t>(options_.most_nodes)) return;
      states_.split(direction, intervals);
    }
  }

  StrainGrid grid() const { return {states_.nodes()}; }
  std::vector<double> energies() const {
    std::vector<double> W;
    for (const CellState& s : states_.all()) W.push_back(s.resultants.energy_J_per_m2);
    return W;
  }
  const StrainStates& states() const { return states_; }

 private:
  StrainSpline<1> splineOf() const { return {grid(), energies(), {even_ ? 1 : 0}}; }

  void setLargest(HomogenisedCell& out) const {
    out.largest_tension_N_per_m = out.largest_shear_N_per_m = 0;
    for (const CellState& s : states_.all()) {
      const CellResultants& n = s.resultants;
      out.largest_tension_N_per_m = std::max({out.largest_tension_N_per_m, std::abs(n.n11), std::abs(n.n22)});
      out.largest_shear_N_per_m = std::max(out.largest_shear_N_per_m, std::abs(n.n12));
    }
  }

  /// n of the spline less n of a cell, each component by the largest of its kind.
  static Strain errorOf(const StrainSpline<1>& spline, const CellLoad& load, const CellResultants& n,
                        const HomogenisedCell& out) {
    std::array<StrainTaylor, 1> W;
    spline.evaluate(strainOf(load), W);
    const auto by = [](double error, double largest) { return largest > 0 ? error / largest : 0; };
    return {by(W[0].first[0] - n.n11, out.largest_tension_N_per_m),
            by(W[0].first[1] - n.n22, out.largest_tension_N_per_m),
            by(W[0].first[2] - n.n12, out.largest_shear_N_per_m)};
  }

  void setNodeErrors(const StrainSpline<1>& spline, const HomogenisedCell& out) {
    node_errors_.clear();
    for (const CellState& s : states_.all()) node_errors_.push_back(errorOf(spline, s.load, s.resultants, out));
  }

  /// What one direction of the grid errs.
  struct Along {
    Strain greatest{};              ///< of each component
    std::vector<double> by_wanted;  ///< of each interval, in parts of what is wanted
  };

  Along errorsAlong(int d, const StrainSpline<1>& spline, const HomogenisedCell& out) {
    constexpr double kSlope = 0.21132486540518713, kValue = 0.5;  // (3 - sqrt(3))/6
    const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
    const std::size_t intervals = states_.nodes()[d].size() - 1;
    std::vector<StrainStates::Between> all, fresh;
    for (const double on_a : lines_[a])
      for (const double on_b : lines_[b])
        for (std::size_t i = 0; i < intervals; ++i)
          for (const double part : {kSlope, kValue}) {
            StrainStates::Between place{{}, d, part};
            place.node[d] = i, place.node[a] = nodeAt(a, on_a), place.node[b] = nodeAt(b, on_b);
            all.push_back(place);
            if (!answers_.contains(strainOf(states_.loadAt(place)))) fresh.push_back(place);
          }
    const std::vector<CellResultants> found = states_.answersAt(fresh);
    for (std::size_t m = 0; m < fresh.size(); ++m) answers_[strainOf(states_.loadAt(fresh[m]))] = found[m];

    Along along;
    along.by_wanted.assign(intervals, 0.0);
    const auto add = [&](std::size_t interval, int c, double error) {
      const double wanted = c == 2 ? options_.shear_error : options_.tension_error;
      along.greatest[c] = std::max(along.greatest[c], std::abs(error));
      along.by_wanted[interval] = std::max(along.by_wanted[interval], std::abs(error) / wanted);
    };
    for (const StrainStates::Between& place : all) {
      const CellLoad load = states_.loadAt(place);
      const Strain here = errorOf(spline, load, answers_.at(strainOf(load)), out);
      StrainStates::Node next = place.node;
      ++next[d];
      const Strain &low = node_errors_[states_.index(place.node)], &high = node_errors_[states_.index(next)];
      for (int c = 0; c < 3; ++c)
        add(place.node[d], c, c == d ? here[c] : here[c] - (1 - place.part) * low[c] - place.part * high[c]);
    }
    for (std::size_t m = 0; m < node_errors_.size(); ++m) {
      const std::size_t i = states_.nodeOf(m)[d];
      if (i > 0) add(i - 1, d, node_errors_[m][d]);
      if (i < intervals) add(i, d, node_errors_[m][d]);
    }
    return along;
  }

  std::size_t nodeAt(int direction, double strain) const {
    const std::vector<double>& nodes = states_.nodes()[direction];
    return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), strain) - nodes.begin());
  }

  const HomogeniseOptions& options_;
  const bool even_;
  StrainStates states_;
  std::array<std::array<double, 3>, 3> lines_;
  std::map<Strain, CellResultants> answers_;  ///< of places checked
  std::vector<Strain> node_errors_;
};

/// b and D at the nodes of `first`, which are among those of the states.
void addBending(const RodCell& cell, const StrainStates& states, const Nodes& first, bool even, LawTableData& table) {
  table.bending.nodes = first;
  std::vector<const CellState*> at(table.bending.count());
  const auto place = [&](int d, double strain) {
    const std::vector<double>& nodes = states.nodes()[d];
    return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), strain) - nodes.begin());
  };
  for (std::size_t i = 0; i < first[0].size(); ++i)
    for (std::size_t j = 0; j < first[1].size(); ++j)
      for (std::size_t k = 0; k < first[2].size(); ++k)
        at[table.bending.index(i, j, k)] =
            &states.at({place(0, first[0][i]), place(1, first[1][j]), place(2, first[2][k])});
  const bool equal_faces = hasEqualFaces(cell.yarns().weave);
  table.rigidity.resize(at.size());
  if (!equal_faces) table.moment.resize(at.size());
  std::vector<std::string> failures(at.size());
  forAllUneven(Each::much, static_cast<int>(at.size()), [&](int m) {
    EquilibriumWork work(cell);
    try {
      CellBending bending = bendingOf(cell, at[m]->load, at[m]->sections, work);
      if (even && at[m]->load.g12 == 0)  // odd in shear
        bending.moment_N[2] = bending.rigidity_Nm[4] = bending.rigidity_Nm[5] = 0;
      table.rigidity[m] = bending.rigidity_Nm;
      if (!equal_faces) table.moment[m] = bending.moment_N;
    } catch (const std::exception& e) {
      failures[m] = e.what();
    }
  });
  for (std::size_t m = 0; m < at.size(); ++m)
    if (!failures[m].empty()) throw NoEquilibrium(at[m]->load, failures[m]);
}

HomogenisedCell homogeniseOver(const RodCell& cell, const HomogeniseOptions& options) {
  HomogenisedCell out;
  const bool even = isMirrorSymmetric(cell.yarns().weave);
  Nodes first;
  for (int d = 0; d < 3; ++d) {
    auto& [low, high] = out.range[d] = options.range[d];
    if (d == 2 && even) high = std::max(-low, high), low = -high;
    first[d] = nodesThroughZero(d == 2 && even ? 0 : low, high, options.first_nodes[d]);
  }
  Refinement refinement(cell, first, even, options);
  refinement.run(out);
  out.table.even_in_shear = even;
  out.table.membrane = refinement.grid();
  out.table.energy = refinement.energies();
  addBending(cell, refinement.states(), options.rigidity_by_strain ? first : Nodes{{{0.0}, {0.0}, {0.0}}}, even,
             out.table);
  return out;
}

}  // namespace

HomogenisedCell homogenise(const RodCell& cell, const HomogeniseOptions& options) {
  constexpr int kShrinks = 10;
  constexpr double kShrink = 0.8;
  check(options);
  HomogeniseOptions within = options;
  for (int shrinks = 0;; ++shrinks) {
    try {
      return homogeniseOver(cell, within);
    } catch (const NoEquilibrium&) {
      if (!options.shrink || shrinks == kShrinks) throw;
    }
    for (auto& [low, high] : within.range) low *= kShrink, high *= kShrink;
  }
}

}  // namespace gambeson
