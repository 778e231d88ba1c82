#pragma once
/// What a layer of cloth is made of: patches at rest, the seams between them, and the fabric.

#include <string>
#include <vector>

#include "core/material/fabric.hpp"
#include "core/nurbs/nurbs.hpp"

namespace gambeson {

enum class Side { u0, u1, v0, v1 };

/// One edge of a patch. `reversed` runs it against its parameter.
struct PatchEdge {
  int patch = 0;
  Side side = Side::u0;
  bool reversed = false;
};

/// C0: positions joined, with a rotational spring of `stiffness_N` (moment per length and radian, N m/(m rad));
/// G1: tangents joined through the map T (Zheng 2013, eq. 2.35), which needs a rest geometry that is G1 with a constant ratio.
enum class SeamKind { C0, G1 };

/// Joins edge `a` to edge `b`. Where `b_from`, `b_to` are not 0 and 1, edge `a` is joined to that part of edge `b`
/// (fractions of b's parameter range, along b's sense).
struct Seam {
  PatchEdge a, b;
  SeamKind kind = SeamKind::G1;
  double stiffness_N = 0;
  double b_from = 0, b_to = 1;
};

/// A layer at rest. The weft direction at a point of patch i is weft[i] projected on the rest surface.
struct Garment {
  std::string name;
  std::vector<NurbsPatch> patches;
  std::vector<Seam> seams;
  std::vector<Vec3> weft;
  Fabric fabric;
};

}  // namespace gambeson
