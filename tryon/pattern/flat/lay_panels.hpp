#pragma once
/// Detail of place_panels.hpp: panels side by side in one plane, as their seams have them.

#include <functional>
#include <span>
#include <vector>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// Two points that a seam brings together, with the outward normals of their edges, in their panels' planes.
struct SeamPair {
  int a = 0, b = 0;  ///< panels
  Vec2 xa, xb, na, nb;
  double length_m = 0;  ///< of seam that they stand for
};
/// Of all seams, 32 of each.
std::vector<SeamPair> seamPairs(const FlatPattern& pattern);
/// The same the other way around.
SeamPair turned(const SeamPair& p);

/// A panel in a plane of several: x' = at + (x . right, x . up), right and up two unit vectors of its own plane.
struct LaidPanel {
  int panel = 0;
  Vec2 right{1, 0}, up{0, 1}, at{};
  std::vector<Vec2> outline;  ///< flattened, as it is laid
  Vec2 of(Vec2 x) const { return {at.x + x.x * right.x + x.y * right.y, at.y + x.x * up.x + x.y * up.y}; }
  Vec2 turn(Vec2 n) const { return {n.x * right.x + n.y * right.y, n.x * up.x + n.y * up.y}; }
  void move(Vec2 by);
  Vec2 low() const;
  Vec2 high() const;
};

/// Panels that hang together by seams among them.
using LaidPart = std::vector<LaidPanel>;

/// The panel with its warp upright: its grain line where that is within 30 degrees of its y axis, or of its x axis (it
/// was drawn lying: up is then where more of its border is sewn); between these it is cut on the bias, and its y axis
/// is up, as where it has no grain. Of `sleeve`, panels around an arm, that without a grain has its end at the shoulder
/// up: of its axes the one that points most towards where it is sewn to panels that are none of these.
LaidPanel upright(const FlatPattern& pattern, int panel, std::span<const SeamPair> pairs,
                  std::span<const int> sleeve = {});

/// Parts of those panels of the pattern: neighbours by a seam have their middles side by side or above each other, as
/// the seam's edge runs, `gap_m` apart; none lies on another.
std::vector<LaidPart> layPanels(const FlatPattern& pattern, std::span<const LaidPanel> panels,
                                std::span<const SeamPair> pairs, double gap_m);

/// By how much `b` must go along x (sense +1 or -1) so that nowhere at one height it is before `a` or nearer than
/// gap_m; 0 where they share no height.
double wayPast(const LaidPanel& a, const LaidPanel& b, int sense, double gap_m);

/// Length of the panel's cloth at a height of the plane it is laid in.
double widthAt(const LaidPanel& panel, double height);

}  // namespace gambeson
