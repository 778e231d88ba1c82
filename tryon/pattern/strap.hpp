#pragma once
/// A strap over the left shoulder: a straight strip as it lies under even tension.

#include <array>
#include <vector>

#include "tryon/pattern/form.hpp"

namespace gambeson {

/// Its two ends, each as points from the inner to the outer side (y grows), and how far it keeps from the body.
struct StrapLine {
  static constexpr int lines = 6;
  std::vector<Vec3> front, back;  ///< lines + 1 points each
  double width_m = 0, clearance_m = 0;
};

/// A strip that pulls evenly across its width has, at every place, no bending moment in its plane, so that nothing may
/// push it sideways: without friction its middle line is a geodesic of what it lies on (T k_g = 0), and then strips of
/// equal tension beside it are, to first order, as long as it is. On a shoulder that slopes down outward such a line
/// leans outward as it goes up; one that is cut upright slides down the slope until it hangs on the inner corners of
/// its seams and on its outer edge over the shoulder.
///
/// The middle line lies in a plane through its ends, and the other lines in planes beside it. These lean so that the
/// taut strings in them are the shortest, summed over the width: lines of one tension then do no work when they slide
/// (virtual work of a turn about the line between the ends). Each line is cut to the length of its own string, which
/// takes up what the shoulder's curvature across the strip asks for. Cross lines have the width; they are square to the
/// strip, but for 8 cm at the ends, where they turn into these.
class Strap {
 public:
  Strap(const StrapLine& line, const BodyForm& form);
  double length() const { return strings_[StrapLine::lines / 2].at.back(); }
  double lean() const { return lean_; }  ///< outward at the top against the vertical [rad]
  /// s from the inner side (0) to the outer, t from front to back.
  Vec3 at(double s, double t) const;

 private:
  /// A polyline in a plane (x, z), and its length up to each point.
  struct String {
    std::vector<Vec2> points;
    std::vector<double> at;
    Vec2 point(double s) const;
  };
  static String string(const Vec3& front, const Vec3& back, const std::vector<double>& support);
  double lengthAt(double lean_rad, const BodyForm& form) const;
  Vec2 point(int i, double t) const;
  std::array<Vec3, StrapLine::lines + 1> crossLine(double t) const;

  StrapLine line_;  ///< leaned
  double lean_ = 0;
  std::vector<String> strings_;
};

}  // namespace gambeson
