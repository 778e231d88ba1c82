#pragma once
/// A strap over the left shoulder: a ribbon of constant width along a taut string.

#include <vector>

#include "tryon/pattern/form.hpp"

namespace gambeson {

/// Its two ends, each as points from the inner to the outer side (y grows), and how far it keeps from the body.
struct StrapLine {
  static constexpr int lines = 6;
  std::vector<Vec3> front, back;  ///< lines + 1 points each
  double width_m = 0, clearance_m = 0;
};

/// The middle line lies in planes of constant y; its shape is that of a string from end to end over the body's profiles
/// under the strap. The ribbon's cross lines are d = dy e_y - m n, n the string's normal, with |d| the width: the outer
/// side is lower at the top and farther back at the chest, as the ends are. Near the ends it goes over into them.
class Strap {
 public:
  Strap(const StrapLine& line, const BodyForm& form);
  double length() const { return at_.back(); }
  /// s from the inner side (0) to the outer, t from front to back.
  Vec3 at(double s, double t) const;

 private:
  Vec3 ribbon(double s, double t) const;
  Vec2 point(double length) const;

  StrapLine line_;
  std::vector<Vec2> string_;  ///< (x, z)
  std::vector<double> at_;
};

}  // namespace gambeson
