#pragma once
/// Patterns in DXF as AAMA and ASTM D6673 have them: a block for each piece, layers for what a line is.
///
///   1 boundary (cut line), 2 turn points (corners), 3 curve points, 4 and 80 to 83 notches, 5 grade reference, 6
///   mirror line, 7 grain line, 8 internal lines, 9 stripe and 10 plaid reference, 11 cutouts, 13 drill holes, 14 sew
///   lines, 15 annotation, 84 to 87 the lines of 1, 8, 11 and 14 again, for checking. UNITS: METRIC is mm, ENGLISH is
///   inches.

#include <filesystem>

#include "cases/pattern/imported.hpp"

namespace gambeson {

/// Reads one. The outline is the closed sew line where there is one, else the boundary. Seams are those of
/// texts that patternDxf writes, or proposed (proposeSeams): the format has none. Throws InputError with the file, the
/// block and the layer: open boundaries, units that nobody says, several sizes without a choice; what checkPattern
/// refuses, and what readDxfFile does.
ImportedPattern readDxf(const std::filesystem::path& file, const ImportChoices& choices);

}  // namespace gambeson
