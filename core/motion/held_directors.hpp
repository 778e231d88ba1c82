#pragma once
/// Directors that supports of a structure hold or turn, in explicit steps.

#include <array>
#include <span>
#include <vector>

#include "core/statics/structure.hpp"

namespace gambeson {

/// Of cloth whose inner values turn (Cloth::turnsInner): directors, three numbers and three rates each. A director that
/// is held whole stands where its supports turn it to, and has no rates of its own. Of one that may turn about some
/// axes alone the torque is taken on those, all of one inertia: its spin, which begins at rest, keeps to them.
class HeldDirectors {
 public:
  HeldDirectors() = default;
  /// Throws InputError where a support ties a director to anything else, or turns one that it does not hold whole.
  explicit HeldDirectors(const Structure& structure);

  void place(const Structure& structure, double t, std::span<double> inner) const;
  void hold(std::span<double> torque) const;

 private:
  struct Held {
    int director = 0;
    bool whole = true;
    std::array<double, 9> on{};  ///< the projection on the axes that are left
  };
  std::vector<Held> held_;
  bool any_whole_ = false;
};

}  // namespace gambeson
