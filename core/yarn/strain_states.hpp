#pragma once
/// Equilibria of a flat cell at the nodes of a grid of strains.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/yarn/cell_state.hpp"

namespace gambeson {

/// Thrown where a load has no stable equilibrium.
class NoEquilibrium : public RunError {
 public:
  NoEquilibrium(const CellLoad& load, const std::string& why)
      : RunError("the cell finds no stable equilibrium under " + inWords(load) + ": " + why), load_(load) {}
  const CellLoad& load() const { return load_; }

 private:
  CellLoad load_;
};

/// Nodes in E11, E22, 2 E12, ascending; states in the order of law tables, E11 slowest. Work is cut into lines of
/// nodes that are fixed: each goes from a state that is known, each of its loads from what the two before it lead to
/// (or lie between), so that the bits do not depend on threads.
class StrainStates {
 public:
  /// From rest along shear, from there along E11, from there along E22. Throws NoEquilibrium, of the first in the order
  /// of the nodes.
  StrainStates(const RodCell& cell, const std::array<std::vector<double>, 3>& nodes, const EquilibriumOptions& options);

  using Node = std::array<std::size_t, 3>;

  const std::array<std::vector<double>, 3>& nodes() const { return nodes_; }
  std::size_t count() const { return states_.size(); }
  std::size_t index(const Node& n) const { return (n[0] * nodes_[1].size() + n[1]) * nodes_[2].size() + n[2]; }
  Node nodeOf(std::size_t index) const {
    return {index / (nodes_[1].size() * nodes_[2].size()), index / nodes_[2].size() % nodes_[1].size(),
            index % nodes_[2].size()};
  }
  const CellState& at(const Node& n) const { return states_[index(n)]; }
  std::span<const CellState> all() const { return states_; }

  /// Nodes half way in these intervals of a direction, ascending; each state from its two neighbours.
  void split(int direction, std::span<const int> intervals);

  /// A strain between two neighbours of the grid in one direction: `part` of the way from a node to the next.
  struct Between {
    Node node;
    int direction;
    double part;
  };
  CellLoad loadAt(const Between& place) const;
  /// What the cell answers at places.
  std::vector<CellResultants> answersAt(std::span<const Between> places) const;

 private:
  CellLoad loadOf(const Node& n) const { return {nodes_[0][n[0]], nodes_[1][n[1]], nodes_[2][n[2]], 0, 0}; }
  /// Both ways from a node that is known, along a direction.
  void goOut(std::span<const Node> from, int direction);
  static void throwFirst(std::span<const std::string> failures, const std::function<CellLoad(std::size_t)>& load);

  const RodCell& cell_;
  EquilibriumOptions options_;
  std::array<std::vector<double>, 3> nodes_;
  std::vector<CellState> states_;
};

}  // namespace gambeson
