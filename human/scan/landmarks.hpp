#pragma once
/// Where a body without a skeleton has its limbs: what its sections and branches show.

#include <array>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "human/scan/loops.hpp"

namespace gambeson {

/// A limb as sections across it, from its far end towards the trunk: centres, directions towards the trunk, girths and
/// how far each lies from the first centre along the line of centres [m].
struct LimbLine {
  std::vector<Vec3> centre, direction;
  std::vector<double> girth, along;

  std::size_t size() const { return centre.size(); }
  /// The centre at a length along the line, beyond its ends along the last direction.
  Vec3 at(double along) const;
};

/// Index 0 is the right side, 1 the left. The body stands as upright() leaves it: x forward, y left, z up, feet at 0.
struct Landmarks {
  double stature_m = 0;
  Vec3 crotch;                  ///< between the legs where they part
  std::array<LimbLine, 2> leg;  ///< by levels, from above the foot to the crotch
  std::array<LimbLine, 2> arm;  ///< from the hand to the armpit, the last section before arm and trunk are one
  std::array<Vec3, 2> hand_tip, toe_tip, heel;
  std::array<Vec3, 2> ball;     ///< mean of the foot's foremost quarter
  std::array<Vec3, 2> armpit;   ///< the point of an arm's last section that is nearest to the trunk below
  std::array<double, 2> wrist;  ///< along the arm: where it is thinnest between hand and forearm
  CutLoop neck;                 ///< the thinnest level between shoulders and head
  double neck_height_m = 0;
};

/// Throws InputError with `file` and the landmark as key: what was not found, where it was looked for, and what helps.
Landmarks landmarksOf(const TriangleMesh& body, const std::string& file);

/// The vertices of each leg below the crotch (1 right, 2 left), 0 elsewhere.
std::vector<char> legsBelow(const TriangleMesh& body, double height_m);

}  // namespace gambeson
