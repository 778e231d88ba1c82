#pragma once
/// Equilibria of a cell under many loads, each found from others.

#include <string>

#include "core/yarn/cell_response.hpp"

namespace gambeson {

struct CellState {
  CellLoad load;
  std::vector<Pose> sections;
  CellResultants resultants;
};

/// Sections for the load `to` if they changed linearly from a to b: at the part 0 they are a's, at 1 b's; parts below
/// and above go on beyond. The motion of the cloth is taken out first (carried), so what is left is what the yarns do
/// in it.
std::vector<Pose> mixed(const CellState& a, const CellState& b, double part, const CellLoad& to);

/// The equilibrium under `to` from sections that may be near, or by changeLoad from the state `from` where these lead
/// to none that is stable. Returns why it failed, empty where it did not.
std::string findState(const RodCell& cell, const CellState& from, std::vector<Pose> near, const CellLoad& to,
                      EquilibriumWork& work, const EquilibriumOptions& options, CellState& out);

/// "E11 0.1, E22 0, 2 E12 0.5"
std::string inWords(const CellLoad& load);

}  // namespace gambeson
