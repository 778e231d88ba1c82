#pragma once
/// Lengths at rest along one side of a sewn seam.

#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// A point of a sewn edge.
struct SewnPoint {
  int patch = 0;
  Vec2 uv;
  Vec2 along;          ///< d(u, v)/dl by length at rest, in the sense of the edge [1/m]
  Vec3 tangent;        ///< unit, at rest
  double cells_per_m;  ///< knot cells that the edge crosses for each metre: |(du/Du, dv/Dv)|/dl
};

/// Finds points of an edge by their fraction of its length, to 1e-12 of it. Lives no longer than the garment and the
/// edge.
class SewnLength {
 public:
  /// Throws InputError (key `key`) where a part names no patch, is no curve, leaves its patch or has no length.
  SewnLength(const Garment& garment, const SewnEdge& edge, const std::string& key);

  double length_m() const { return stations_.back().length_m; }
  SewnPoint at(double fraction) const;
  double cells() const;  ///< that the edge crosses, in all
  /// Fractions at which parts meet, 0 and 1 among them.
  std::vector<double> corners() const;

 private:
  struct Station {
    int part = 0;  ///< that begins or goes on here
    double t = 0;
    double length_m = 0;  ///< up to here
  };
  struct Speed {
    Vec2 uv, tangent;  ///< of the curve
    Vec3 x;            ///< dx/dt at rest
  };
  Speed speed(int part, double t) const;
  /// Length between two parameters of a part that are near each other.
  double lengthBetween(int part, double from, double to) const;

  const Garment& garment_;
  const SewnEdge& edge_;
  std::vector<Station> stations_;  ///< ascending in length; the last has the part of the one before
};

}  // namespace gambeson
