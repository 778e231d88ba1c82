#pragma once
/// Where the yarns of a weave lie at rest: paths of half sine waves, elliptical sections.

#include <array>
#include <optional>

#include "core/math/vec.hpp"
#include "core/yarn/weave.hpp"

namespace gambeson {

/// The two directions of a weave: weft yarns run along axis 1, warp yarns along axis 2, axis 3 is normal to the cloth.
enum YarnDirection : int { along_weft = 0, along_warp = 1 };

/// What all yarns of a direction share.
struct WovenYarn {
  double spacing_m = 0;         ///< between the middles of neighbouring yarns of this direction, > 0
  double amplitude_m = 0;       ///< A: how far the yarn's middle leaves the middle of the cloth, >= 0
  double half_width_m = 0;      ///< a: of the section, across the yarn in the cloth, > 0
  double half_thickness_m = 0;  ///< b: of the section, through the cloth, > 0
};

/// One repeat. Yarn k of a direction lies at (k + 1/2) spacings of its own direction; along it, crossing c lies at
/// (c + 1/2) spacings L of the other direction. Between crossings on different sides the yarn's middle is
///   z = A cos(pi s/L),  s from the crossing where it is on top
/// (Man 2006, section 4.3.5); between crossings on one side it is straight.
struct WovenYarns {
  Weave weave;
  std::array<WovenYarn, 2> yarn;  ///< by YarnDirection

  int count(int direction) const { return direction == along_weft ? weave.wefts : weave.warps; }
  /// Crossings of a yarn of this direction in one repeat.
  int crossings(int direction) const { return count(1 - direction); }
  /// The length of a repeat along a direction [m].
  double period_m(int direction) const { return crossings(direction) * yarn[1 - direction].spacing_m; }
  double area_m2() const { return period_m(along_weft) * period_m(along_warp); }
  /// Whether yarn k is on top at its crossing c.
  bool onTop(int direction, int k, int c) const;
  /// Where on yarn k, in half spacings from its first crossing, half a turn about axis 3 takes the weave to itself; none
  /// where that is so nowhere on it. 0 in a plain weave.
  std::optional<int> halfTurn(int direction, int k) const;
  /// Height of the middle of yarn k, and its slope, at s [m] along its direction.
  double height_m(int direction, int k, double s) const;
  double slope(int direction, int k, double s) const;
  /// Length of yarn k from s0 to s1, by Gauss quadrature between crossings, to 1e-12 where amplitudes are below half
  /// of the spacing [m].
  double arcLength_m(int direction, int k, double s0, double s1) const;
  /// The point of yarn k at s.
  Vec3 middle(int direction, int k, double s) const;
};

/// Throws InputError where the weave falls apart (checkWeave), a number is out of range, neighbours overlap (keys
/// "weft.half_width", "warp.half_width"; 2 a <= spacing), or a yarn runs through one that it crosses (keys
/// "weft.amplitude", "warp.amplitude"). The last is looked for in the plane of each yarn's middle: its lower edge
/// against the section of the yarn below, at 64 places.
void checkWovenYarns(const WovenYarns& yarns);

}  // namespace gambeson
