#pragma once
/// Patterns as DXF in the words of AAMA and ASTM D6673, which readDxf (dxf.hpp) reads.

#include <string>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// DXF (R12, ASCII) in mm at 1:1: a block for each panel with its boundary (layer 1; with a cut line the outline on
/// 14), turn and curve points (2, 3), notches (4, 80 to 83), grain (7), lines on the cloth, cutouts (11) and
/// annotations (15), inserted side by side. Curves are lines through points within 10 um of them. The format has no
/// seams: each is a text of the style, "GAMBESON SEAM: " and the seam as files of ours write it, which readDxf takes
/// and others show. Placements have no words here.
std::string patternDxf(const FlatPattern& pattern);

/// What the texts of seams begin with.
inline constexpr const char* kDxfSeam = "GAMBESON SEAM: ";

}  // namespace gambeson
