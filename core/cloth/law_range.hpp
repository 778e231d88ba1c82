#pragma once
/// How many points of a cloth are strained beyond what their law knows.

namespace gambeson {

/// Of points whose law is an energy at a point (core/material/point_energy.hpp).
struct LawRange {
  long points = 0, beyond = 0;  ///< how many there are, and how many of them are beyond
};

}  // namespace gambeson
