#pragma once
/// How many points of a cloth are strained beyond what their law knows.

#include <optional>
#include <string>

#include "core/material/point_energy.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Of points whose law is an energy at a point (core/material/point_energy.hpp).
struct LawRange {
  long points = 0, beyond = 0;  ///< how many there are, and how many of them are beyond or find no answer
  long unanswered = 0;          ///< how many find none

  /// The first that finds none.
  struct Point {
    int patch = 0;
    Vec2 fraction;  ///< of the patch's range of parameters
    SheetStrain at;
    std::string why;
  };
  std::optional<Point> first;

  /// Adds those of a part whose patches follow that many others.
  void add(const LawRange& part, int patches_before = 0);
};

/// "3 of 32 points find no answer of their law, the first at ... under ...: why". Of a range where some find none.
std::string unansweredInWords(const LawRange& range);

}  // namespace gambeson
