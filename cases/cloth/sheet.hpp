#pragma once
/// A sheet of patches, and how they lie.

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// How patches lie: a grid of count_u x count_v patches (patch i + count_u j), or loose ones.
struct Sheet {
  Garment garment;  ///< without fabrics
  bool grid = false;
  int count_u = 1, count_v = 1;
  bool closed_u = false, closed_v = false;
  double angle_u_rad = 0, angle_v_rad = 0;  ///< of a piece where it is an arc; 0: straight
};

}  // namespace gambeson
