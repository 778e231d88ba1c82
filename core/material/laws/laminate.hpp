#pragma once
/// Membrane and bending of a sheet of plies.

#include <vector>

#include "core/material/laws/given_rigidities.hpp"

namespace gambeson {

/// A, B and D of classical laminate theory (core/material/section.hpp), from the bottom (-normal) to the top; they
/// replace the fabric's own membrane. A solid: free of stress in its curved rest shape.
struct Laminate {
  static constexpr bool is_solid = true;
  std::vector<Ply> plies;

  bool operator==(const Laminate&) const = default;
  Section section(const Voigt& /*A*/, double /*thickness_m*/) const { return laminate(plies); }
  double thickness_m() const {
    double sum = 0;
    for (const Ply& ply : plies) sum += ply.thickness_m;
    return sum;
  }
  void thicken(double factor) {
    for (Ply& ply : plies) ply.thickness_m *= factor;
  }
};

}  // namespace gambeson
