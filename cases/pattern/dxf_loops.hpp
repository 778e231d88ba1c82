#pragma once
/// From the lines of a DXF block to the loops of a panel.

#include <string>
#include <vector>

#include "cases/pattern/dxf_file.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// A way along points; bulges[k] is tan(angle / 4) of the arc from point k to the next.
struct DxfChain {
  std::vector<Vec2> points;
  std::vector<double> bulges;
  bool closed = false;
};

/// The chains of a layer, in m, those whose ends meet (within 0.1 mm) joined to longer ones; circles as two arcs.
/// Points that follow each other are more than a micrometre apart.
std::vector<DxfChain> chainsOf(const std::vector<DxfEntity>& entities, const std::string& layer, double metres);

/// Ends of an open chain apart [m].
double gapOf(const DxfChain& chain);

/// A closed chain as a loop, split into edges at the corners that `turns` has (within 0.02 mm) and at arcs; where it
/// has none of the chain's points, where the chain turns by more than 30 degrees. Lines are straight edges or
/// polylines, bulges arcs. Says in `guessed` whether the corners are guesses.
PanelLoop loopOf(const DxfChain& chain, const std::vector<Vec2>& turns, bool& guessed);

}  // namespace gambeson
