#pragma once
/// Flat panels as cloth: each a trimmed NURBS rectangle on its grain, flat at rest where its placement has it, and the
/// pattern's seams between them (core/cloth/draft/sewn_seam.hpp).

#include "core/cloth/draft/garment.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

struct PanelCells {
  double cell_m = 0.02;  ///< wanted size of a cell, > 0
  int degree = 2;
};

/// A patch for each panel, by its name: parameters (u, v) in m along weft and warp, u x v towards the right side; its
/// rectangle is as large as the panel, whose outline and cutouts trim it. A panel in which both sides of a seam meet (a
/// dart) is cut on through their tip (panel_pieces.hpp): its pieces are patches one after the other, "front",
/// "front 2". Seam k is seam k; after them come buttons of open ones, and cuts. Openings are sewn unless they are said
/// to be open. Takes patterns that checkPattern lets pass. Throws InputError (key "panels[i]" or "seams[i]", names in
/// the reason) where a panel has no placement, is cut more than once or cannot be cut on through a tip, or where the
/// sides of a seam are too unequal or no border. Without a fabric. `panel_of`: the panel that each patch is of.
Garment panelGarment(const FlatPattern& pattern, const PanelCells& cells, std::vector<int>* panel_of = nullptr);

/// "front.1 + yoke.0", as seams name their sides.
std::string sideText(const FlatPattern& pattern, const std::vector<SeamPart>& side);

}  // namespace gambeson
