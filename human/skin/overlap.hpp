#pragma once
/// Where a skin has folded into itself.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/contact/bounding_tree.hpp"
#include "core/contact/contact_mesh.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

/// Triangles of a closed surface that pass through others, and those whose outside lies within the body: what cloth
/// could not touch without being inside.
struct Overlap {
  std::vector<char> triangles;
  double area_m2 = 0;  ///< of these
};
/// Searches one mesh in many postures.
class OverlapSearch {
 public:
  OverlapSearch(std::vector<std::array<int, 3>> triangles, int vertices);

  /// `room_m`: of the surface as it would be half of that farther out, so that what faces itself nearer than that
  /// counts too: cloth that needs this room has none there. `among`: which triangles may pass through which, by
  /// triangle; empty: all.
  Overlap at(std::span<const Vec3> x, double room_m, std::span<const char> among = {});

 private:
  std::vector<std::array<int, 3>> triangles_;
  ContactMesh mesh_;
  BoundingTree tree_;
};
/// Of one posture.
Overlap overlapOf(const std::vector<std::array<int, 3>>& triangles, std::span<const Vec3> x, double room_m = 0);

/// Area of some triangles.
double areaOf(const std::vector<char>& which, const std::vector<std::array<int, 3>>& triangles,
              std::span<const Vec3> x);

/// Links whose parts of the skin some triangles are.
std::vector<std::string> linksOf(const std::vector<char>& triangles, const Human& human);

/// The same over a motion, from its begin to its end.
struct OverlapOfMotion {
  std::vector<char> triangles;  ///< at any of the instants
  double area_m2 = 0;           ///< of all these, in the skin's bind posture
  int instants = 0, folded = 0;
  double largest_m2 = 0, largest_time_s = 0;
  std::vector<std::string> links;  ///< whose parts of the skin take part
};
OverlapOfMotion overlapOf(const Human& human, const Motion& motion, double step_s);

}  // namespace gambeson
