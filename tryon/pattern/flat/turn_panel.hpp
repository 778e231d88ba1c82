#pragma once
/// Panels as the model wants them: right side up, cloth to the left of every edge.

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// The same loop run the other way: edge k becomes edge n - 1 - k.
PanelLoop reversed(const PanelLoop& loop);

/// Seen from the other side: x becomes -x, and the placement's along_x turns round, so that every point stays where it
/// stands. Edges keep their numbers; loops that ran clockwise run counter-clockwise.
void mirror(Panel& panel);

}  // namespace gambeson
