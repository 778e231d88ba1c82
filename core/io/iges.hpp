#pragma once
/// NURBS surfaces as an IGES 5.3 file, which CAD programs read: one rational B-spline surface (entity 128) per patch,
/// bounded by its trimming loops (144, with curves on surface 142 of rational B-spline curves 126), each with its name
/// (property 406, form 15).

#include <filesystem>
#include <string>
#include <vector>

#include "core/nurbs/trim.hpp"

namespace gambeson {

struct IgesSurface {
  std::string name;
  NurbsPatch patch;  ///< control points [m]
  Trim trim;         ///< without loops: the whole patch
};

/// The file, in millimetres; the same bytes for the same surfaces. `title` and names: what is not ASCII becomes '_'.
/// The loops' curves in the parameter plane are exact and preferred (142, PREF 1); beside them stand the loops in space
/// as polylines within `tolerance_m` of the surface's, for programs that ask for them.
/// A loop that runs counter-clockwise bounds a surface of its own (144) with the clockwise loops inside it as holes;
/// without one the patch's own border is the outline. Throws InputError where a trim is not valid (trimBoundary).
std::string igesText(const std::string& title, const std::vector<IgesSurface>& surfaces, double tolerance_m = 1e-5);

/// Replaces the file atomically; RunError where it cannot be written.
void writeIges(const std::filesystem::path& file, const std::string& title, const std::vector<IgesSurface>& surfaces);

}  // namespace gambeson
