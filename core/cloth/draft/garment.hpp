#pragma once
/// What cloth is made of: patches at rest, the seams between them, and the fabric.

#include <string>
#include <vector>

#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/sewn_seam.hpp"
#include "core/cloth/patch_edge.hpp"
#include "core/material/fabric.hpp"
#include "core/nurbs/trim.hpp"

namespace gambeson {

/// C0: positions joined; G1: tangents joined as well through the map T (Zheng 2013, eq. 2.35), which needs a rest
/// geometry that is G1 with a constant ratio. At the end of a G1 seam where other than two patches (on the border) or
/// four (inside) meet, the corner control point stays C0.
enum class SeamKind { C0, G1 };

/// Joins edge `a` to edge `b` point by point: same degree, same knots up to their range, same weights.
/// `stiffness_N` is that of a rotational spring along the seam, moment per length and angle from rest [N m/(m rad)].
/// With `first_cell` >= 0 the whole of `a` lies on a part of `b`: on as many of its cells as `a` has, from this one on
/// in the sense of `b` (core/cloth/draft/part_seam.hpp). Such seams are C0, and their edges have equal weights.
struct Seam {
  PatchEdge a, b;
  SeamKind kind = SeamKind::G1;
  double stiffness_N = 0;
  int first_cell = -1;

  bool onPart() const { return first_cell >= 0; }
};

/// Joins edges `a` and `b` whose knots, degrees or weights differ, by a penalty (core/cloth/shell/weak_seam.hpp). They
/// lie on one curve at rest, or one lies on a part of the other. G1: the angle between the patches is kept, smooth or
/// creased; C0: it is free but for a spring `stiffness_N`, as in Seam.
struct WeakSeam {
  PatchEdge a, b;
  SeamKind kind = SeamKind::G1;
  double stiffness_N = 0;
  double factor = 1e3;  ///< penalty over the stiffness of a cell
};

/// Cloth at rest: one garment, or several worn over each other (core/cloth/draft/join_garments.hpp). The weft direction
/// at a point of patch i is weft[i] projected on the rest surface. `trims`, `fields`, `garment_of_patch`, `patch_names`
/// and `placed` are empty, or hold one entry per patch.
struct Garment {
  std::string name;
  std::vector<NurbsPatch> patches;
  std::vector<Seam> seams;
  std::vector<Vec3> weft;
  std::vector<Trim> trims;
  Fabric fabric;
  std::vector<Fabric> other_fabrics;  ///< what material fields choose from, beside `fabric`
  std::vector<PatchFields> fields;
  std::vector<WeakSeam> weak_seams;
  std::vector<int> garment_of_patch;  ///< garment that a patch belongs to, 0 innermost; empty: one garment

  std::vector<std::string> patch_names;  ///< of each patch, or empty
  std::vector<NamedEdge> edges;
  /// Where the control points of each patch stand when they do not start at rest (a belt that is put on stretched);
  /// empty, or one list per patch, empty where the patch starts at rest.
  std::vector<std::vector<Vec3>> placed;
  std::vector<SewnSeam> sewn_seams;  ///< of panels that are flat at rest

  int garmentOf(int patch) const { return garment_of_patch.empty() ? 0 : garment_of_patch[patch]; }
};

/// Throws InputError where fabrics, patches, fields or lists of one entry per patch are no good; seams are another
/// matter (buildFreeMap).
void checkGarment(const Garment& garment);

}  // namespace gambeson
