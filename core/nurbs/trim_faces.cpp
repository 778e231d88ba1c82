#include "core/nurbs/trim_faces.hpp"

#include <limits>
#include <stdexcept>

#include "core/nurbs/trim_arcs.hpp"
#include "core/nurbs/trim_notches.hpp"

namespace gambeson {

std::vector<Trim> facesOf(const NurbsPatch& patch, const Trim& given) {
  if (given.loops.empty()) return {given};
  // Wires of a face must not touch.
  const Trim trim = withoutNotches(patch, given);
  const TrimBoundary boundary = trimBoundary(patch, trim);
  std::vector<Trim> faces;
  std::vector<double> area;  // of each outline
  if (boundary.rectangle_is_outline) {
    faces.emplace_back();
    area.push_back(std::numeric_limits<double>::infinity());
  }
  for (std::size_t l = 0; l < trim.loops.size(); ++l)
    if (boundary.signed_area[l] > 0) {
      faces.push_back({{trim.loops[l]}});
      area.push_back(boundary.signed_area[l]);
    }
  std::vector<TrimBoundary> outlines;
  for (const Trim& f : faces) outlines.push_back(trimBoundary(patch, f));
  for (std::size_t l = 0; l < trim.loops.size(); ++l) {
    if (boundary.signed_area[l] > 0) continue;
    const NurbsCurve& c = trim.loops[l][0];
    const Vec2 inside = curvePoint(c, c.knots.front()).point;
    std::size_t least = faces.size();
    for (std::size_t o = 0; o < faces.size(); ++o)
      if ((least == faces.size() || area[o] < area[least]) && outlines[o].winding(inside) > 0) least = o;
    if (least == faces.size()) throw std::logic_error("a hole without an outline");
    faces[least].loops.push_back(trim.loops[l]);
  }
  return faces;
}

}  // namespace gambeson
