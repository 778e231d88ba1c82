#pragma once
/// Sleeves of the drafted shirt, set into its armholes.

#include <array>
#include <map>
#include <vector>

#include "core/nurbs/curve.hpp"
#include "tryon/pattern/arm_form.hpp"

namespace gambeson {

/// A piece of the armhole, and of the sleeve's upper edge that is sewn to it.
struct ArmholePart {
  std::vector<Vec3> points;  ///< evenly spaced by its parameter, the first and the last at its ends
  int cells = 0;

  Vec3 at(double s) const;
};

/// The left sleeve as surfaces of (s, t): a strip for each part of the armhole, all side by side around the arm, s
/// counterclockwise seen from the shoulder, t from the hem up to the armhole.
///
/// From the hem up to a little below the armhole the lines of constant s run along the arm at equal shares of the
/// cross-sections' length, as many as there are cells; those under the arm are farther apart. From there each goes over
/// into its point of the armhole: over the shoulder on the convex hull of arm and armhole, as cloth under tension
/// does; under the arm straight, so that sleeve and wrap are the two sides of a fold along their seam. Front and back
/// go over from the one into the other. Along each line t is its share of length, so that outer lines have longer cells
/// than those under the arm, which are shorter.
class SleeveDraft {
 public:
  /// The parts follow each other around the armhole and are closed: front, over the shoulder, back, under the arm.
  /// `wider_under`: around the arm a cell under it is so many times as wide as others. With equal ones, lines of the
  /// back come up along the armhole's edge, and the surface folds there.
  /// Throws InputError, "sleeve_length_m" where the hem does not stand below the armhole by a cell.
  SleeveDraft(const ArmForm& arm, std::array<ArmholePart, 4> armhole, double cell_m, double wider_under);

  int along() const { return along_; }  ///< cells from hem to armhole
  Vec3 at(int part, double s, double t) const;
  /// How far from the armhole, along its line, a point is.
  double belowArmhole(int part, double s, double t) const { return (1 - t) * lineOf(part, s).at.back(); }

 private:
  /// A polyline from hem to armhole in the arm's frame, and its length up to each point.
  struct Line {
    std::vector<Vec3> points;
    std::vector<double> at;
  };
  const Line& lineOf(int part, double s) const;
  Line makeLine(int part, double s) const;
  Vec3 middleAt(double z) const { return {arm_.middle().x, arm_.middle().y, std::min(z, 0.0)}; }
  double reach(const Wrap& of, const Vec3& x) const;

  const ArmForm& arm_;
  std::array<ArmholePart, 4> armhole_;  ///< in the arm's frame
  double wider_under_;
  double bend_ = 0;  ///< z where lines leave the arm for the armhole
  int along_ = 0;
  std::vector<ClosedCurve> tube_;  ///< cross-sections from hem to bend_
  std::vector<double> outermost_;  ///< where on each the outermost point stands
  std::optional<Wrap> hull_;       ///< of arm and armhole, above bend_
  mutable std::map<std::pair<int, double>, Line> lines_;
};

}  // namespace gambeson
