#pragma once
/// Patterns of GarmentCode (Korosteleva and Sorkine-Hornung 2023; `specification.json` of pygarment): panels with
/// curved edges, stitches, placement.

#include "cases/input/json.hpp"
#include "cases/pattern/imported.hpp"

namespace gambeson {

/// Whether JSON looks like such a file: an object with pattern.panels.
bool isGarmentCode(const JsonNode& root);

/// Reads one. What the format means (pygarment/pattern/core.py, utils.py, rotation.py, meshgen/boxmeshgen.py):
///   control points of curves are relative to their edge, start + x e + y perp(e), perp to its left;
///   a circle is [radius, large arc, right], the arc of SVG whose angle grows where `right` is set;
///   a panel stands at R p + t with R = Rz Ry Rx, degrees, y up and z forward; its edges run counter-clockwise as seen
///   from outside, so that clockwise ones are mirrored here;
///   a stitch lays the end of one edge on the start of the other, unless it says "right_wrong".
/// Throws InputError with file, line and key: panels whose edges do not close, unknown curves, stitches of edges that
/// are not there, a unit that is missing (and no choice of one); what checkPattern refuses.
ImportedPattern readGarmentCode(const JsonNode& root, const std::string& file, const ImportChoices& choices);

}  // namespace gambeson
