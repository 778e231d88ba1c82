#pragma once
/// The yarns of a weave as solids of hexahedra.

#include <array>
#include <vector>

#include "core/solid/solid_mesh.hpp"
#include "core/yarn/woven_yarns.hpp"

namespace gambeson {

/// How a yarn is cut into hexahedra.
struct YarnMeshing {
  int across = 4;  ///< of a section, in both of its directions: across² hexahedra; 2 to 16
  /// Of a yarn from the middle between two crossings to the next such middle; odd, 5 to 63. With even numbers nodes of
  /// one yarn stand on ridges of the other where they cross, and fall off them to one side.
  int along = 13;
};

/// One yarn in the mesh: sections one behind the other along it, (across + 1)² nodes each.
struct YarnBody {
  int direction = 0, yarn = 0;  ///< of the weave
  int first_node = 0, first_cell = 0, end_cell = 0;
  int sections = 0;     ///< planes of nodes
  double length_m = 0;  ///< of the middle
};

struct SolidYarns {
  SolidMesh mesh;  ///< materials by YarnDirection, fibres by Gauss point
  std::vector<YarnBody> bodies;
  YarnMeshing meshing;

  /// Node (i, j) of section l of a body: i from -a to a across the yarn, to the left of its direction, j from -b to b
  /// through it.
  int node(const YarnBody& body, int section, int i, int j) const;
  /// The sides of a body, without its ends, seen from outside.
  std::vector<Facet> skin(const YarnBody& body) const;
};

/// One repeat, each yarn from a face of the cell to the other; or, where `quarter` is set, of a plain weave the first
/// weft and the first warp over one spacing, crossing in the middle.
///
/// Sections stand at equal distances along the cloth and perpendicular to the yarn's middle. A square is laid on the
/// ellipse by u = a p sqrt(1 - r²/2), v = b r sqrt(1 - p²/2), -1 <= p, r <= 1, which takes squares about its middle to
/// ellipses. Fibres follow the middle: at a Gauss point they have its direction at the same place along the cloth.
///
/// A mesh of flat facets inside an ellipse is smaller than the yarn, and larger the finer it is; so widths u are
/// scaled, by one factor for each body, until its volume is pi a b times the length of the middle, on every mesh.
/// Heights v are not: yarns touch where they cross and press on each other nowhere.
///
/// Throws InputError as checkWovenYarns, and with the keys "across", "along" where the meshing is out of range, or
/// "extent" where a quarter is asked of a weave that is not plain.
SolidYarns solidYarns(const WovenYarns& yarns, const std::array<BonetBurton, 2>& law, const YarnMeshing& meshing,
                      bool quarter);

}  // namespace gambeson
