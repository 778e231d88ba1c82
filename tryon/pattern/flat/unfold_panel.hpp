#pragma once
/// Halves that are drawn up to a fold, made whole.

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// Mirrors a panel beyond the line through a and b where edges of its outline lie on it, straight and one after the
/// other: these go, and the rest stands twice. So do cutouts, notches and lines; the grain and annotations stand once.
/// A cut line that does not end on the fold is left out. False, and nothing is changed, where no such edges lie there.
bool unfold(Panel& panel, Vec2 a, Vec2 b);

}  // namespace gambeson
