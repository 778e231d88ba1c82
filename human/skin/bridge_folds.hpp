#pragma once
/// Where a skin folds into itself over a motion, and the surface that bridges these folds.

#include <functional>
#include <string>
#include <vector>

#include "human/body/bridged_folds.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

struct BridgingReport {
  int instants = 0, tight = 0;                ///< tight: at which some of the skin lacks its room
  double largest_m2 = 0, largest_time_s = 0;  ///< of what lacks it before it is bridged
  double farthest_m = 0;                      ///< the longest way of a vertex
  double left_m2 = 0, left_time_s = 0;        ///< the largest area that passes through itself all the same, and when
  std::vector<std::string> links;             ///< whose parts of the skin lack it
};

/// Those of `triangles` whose whole part of the mesh, as far as it hangs together, is among them: an eye in a head,
/// which has no rim that could be bridged.
std::vector<char> wholeParts(const TriangleMesh& mesh, const std::vector<char>& triangles);

/// Bridges the folds of the human's skin from begin_s to end_s, looked at every `every_s`: what lacks `room_m`
/// (overlapOf of human/skin/overlap.hpp) at an instant, or one before or after it, is drawn over the rim of what has
/// it, as a net of springs of force per length w = 1/(their length in the bind posture) that is at rest:
///
///     sum_j w_ij (x_j - x_i) = 0 at each vertex i of triangles that lack their room,
///
/// so a fold gets a floor where it is `room_m` wide, and what bulges into what it touches is pressed flat. `posture`:
/// over time.
BridgedFolds bridgeFolds(const Human& human, const std::function<Posture(double)>& posture, double begin_s,
                         double end_s, double every_s, double room_m, BridgingReport& report);

}  // namespace gambeson
