#pragma once
/// Contact forces as arrows show them: summed over small cells of cloth.

#include <vector>

#include "cases/wear/scene/placed_bodies.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// Arrows sum the forces of samples within cells of this size, so that they can be told apart.
inline constexpr double kArrowCell_m = 0.05;
/// Arrows shorter than this part of the longest are left out.
inline constexpr double kLeastArrow = 0.06;

/// The force on the body of all samples in one cell near one body.
struct ForceCluster {
  Vec3 force, moment_of_size;
  double size = 0;
  /// Where it acts in the mean.
  Vec3 middle() const { return moment_of_size / size; }
};

/// Of a frame; `placed` stands at its time.
std::vector<ForceCluster> forceClusters(const PlacedBodies& placed, const Frame& frame, const std::vector<Vec3>& x);
double largestForce(const std::vector<ForceCluster>& clusters);

}  // namespace gambeson
