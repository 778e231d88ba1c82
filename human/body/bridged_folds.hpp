#pragma once
/// A skin whose folds are bridged over a motion: where its sides come nearer to each other than cloth needs, its
/// surface goes across the mouth of the fold instead. Made by human/skin/bridge_folds.hpp.

#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

struct Skin;

/// How far vertices are moved from where the skin has them, at even times: of those of instant i, at first[i] up to
/// first[i + 1], `vertex` and its `way` in the frame of the link of its segment [m].
struct BridgedFolds {
  double begin_s = 0, every_s = 0.02;
  std::vector<int> first, vertex;
  std::vector<Vec3> way;

  bool empty() const { return vertex.empty(); }
};

/// Moves the vertices `x` of the skin with links at `X_WL` as at `time_s`: along the cubic through the instants with
/// central differences as rates, C¹; before the first and after the last instant as in these.
void bridge(const BridgedFolds& folds, const Skin& skin, std::span<const Pose> X_WL, double time_s, std::span<Vec3> x);

}  // namespace gambeson
