#pragma once
/// Faces of CAD files as panels of a flat pattern, or as patches of a garment.

#include <string>
#include <vector>

#include "cases/cad/cad_shape.hpp"
#include "cases/pattern/imported.hpp"
#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Whether all faces are planes: then they are panels as they are cut.
bool isFlat(const CadShape& shape);

/// Names of faces: the file's, or "face_3"; a number behind those that name several.
std::vector<std::string> namesOf(const CadShape& shape);

/// Planes as panels, where the file has them; their shared edges are seams. Throws InputError as checkPattern does.
ImportedPattern panelsOf(const CadShape& shape);

/// A seam of the file, and why the garment does not have it (empty: it does).
struct CadSeamUse {
  std::string a, b;  ///< "front.2": the face and the number of its edge, loop by loop
  double length_m = 0;
  std::string reason;
};

/// Faces as trimmed patches. Of the seams it has those along whole sides of equal knots, joined in position (C0).
/// Throws InputError where the garment is no good (validate).
struct CadGarment {
  Garment garment;
  std::vector<CadSeamUse> seams;
};
CadGarment garmentOf(const CadShape& shape);

}  // namespace gambeson
