#pragma once
/// Faces of CAD files as trimming wants them.

#include "cases/cad/cad_shape.hpp"

namespace gambeson {

/// Turns faces whose outside is against their normal (u and v change places), closes borders whose curves meet within
/// the tolerance of the file, and lays on the patch's border what lies within it of that. Throws InputError (key
/// "face 3 (front)") where surfaces or borders are no good (validate, trimBoundary), coordinates beyond 1000 m, or the
/// area within the border differs from OpenCASCADE's by more than 0.1 %.
void tidyFaces(CadShape& shape);

/// Whether the border is that of the patch.
bool isWhole(const CadFace& face);
/// The loops as a trim; none where the border is the patch's.
Trim trimOf(const CadFace& face);
/// A trimmed patch as faces, to be written: one for each outline (facesOf).
std::vector<CadFace> cadFaces(const std::string& name, const NurbsPatch& patch, const Trim& trim);
/// Area within the trim [m^2]: Gauss points on each cell, of three more than its degree.
double areaOf(const NurbsPatch& patch, const Trim& trim);

}  // namespace gambeson
