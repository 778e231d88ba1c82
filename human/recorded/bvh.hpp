#pragma once
/// Motion capture in Biovision's hierarchy: .bvh files.

#include <filesystem>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// A channel: 0, 1, 2 position along x, y, z; 3, 4, 5 rotation about them [degrees], applied in the order of the file,
/// the last one first to the bone.
struct BvhJoint {
  std::string name;  ///< empty for an end site
  int parent = -1;
  Vec3 offset;  ///< in the file's unit
  std::vector<int> channels;
  int first_channel = 0;
};

struct BvhClip {
  std::string file;
  std::vector<BvhJoint> joints;  ///< parents first
  double frame_time_s = 0;
  std::vector<std::vector<double>> frames;  ///< values of all channels
  std::vector<std::string> notes;

  int joint(const std::string& name) const;  ///< -1 where there is none
  int endSite(int joint) const;              ///< that hangs from it; -1 where there is none
};

/// Throws InputError with file and line.
BvhClip readBvh(const std::filesystem::path& file);

/// Each joint's frame in the file's axes and unit. A joint's position channels replace its OFFSET or add to it.
std::vector<Pose> bvhPoses(const BvhClip& clip, const std::vector<double>& frame, bool position_adds);

}  // namespace gambeson
