#pragma once
/// The skeleton of a digital human: links and joints from URDF, and where they stand for given joint values.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

enum class JointType { fixed, revolute, prismatic };

/// Angles in rad, lengths in m. `X_PJ` is the joint's frame in its parent link for the value 0; `axis` (unit) is in
/// that frame.
struct Joint {
  std::string name;
  JointType type = JointType::fixed;
  int parent = -1, child = -1;  ///< links
  Pose X_PJ;
  Vec3 axis{1, 0, 0};
  double lower = 0, upper = 0;  ///< limits; -inf, inf where the URDF says "continuous"
  std::optional<int> mimic_of;  ///< joint whose value q is followed: multiplier q + offset
  double mimic_multiplier = 1, mimic_offset = 0;
};

struct Link {
  std::string name;
  int parent_joint = -1;  ///< -1 for the root
  double mass_kg = 0;
  Vec3 center_of_mass;  ///< in the link's frame
};

/// Links and joints in an order where parents come first; link 0 is the root. A joint's value sits at its own index.
struct Skeleton {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;

  int link(const std::string& name) const;   ///< -1 where there is none
  int joint(const std::string& name) const;  ///< -1 where there is none
  /// Whether link `a` is `b` or lies distal of it.
  bool isDistal(int a, int b) const;
};

/// The pose of each link in the world, X_WL, for joint values `q` (one per joint; those of fixed and mimic joints are
/// ignored) and the pose of the root link.
std::vector<Pose> linkPoses(const Skeleton& skeleton, std::span<const double> q, const Pose& root);

}  // namespace gambeson
