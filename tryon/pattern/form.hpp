#pragma once
/// The standing body as a pattern maker measures it: cross-sections of the links that are asked for, whether the
/// surface is a list of shapes on links or one closed skin whose vertices name their link.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "human/body/body.hpp"
#include "human/motion/motion.hpp"
#include "tryon/pattern/wrap.hpp"

namespace gambeson {

/// Links by number.
using Links = std::vector<int>;

/// The point in axes that are turned about x: planes of constant y lean outward at the left by `lean_rad` as they go
/// up.
Vec3 leaned(const Vec3& x, double lean_rad);

class BodyForm {
 public:
  /// The skin of a human who stands (human/motion/motion.hpp), or the shapes of one without. `human` outlives the form.
  explicit BodyForm(const Human& human);
  /// The same in another posture.
  BodyForm(const Human& human, const Posture& posture);
  /// A closed skin of the standing human in the world; `segment` is the link of each vertex. A triangle belongs to a
  /// link only with all its vertices, so that cross-sections of the trunk end where arms begin.
  BodyForm(const Human& human, TriangleMesh skin, std::vector<int> segment);

  /// The links of these names; throws InputError (key `key`) where one is missing.
  Links links(std::span<const char* const> names, const char* key) const;
  Links links(std::initializer_list<const char*> names, const char* key) const {
    return links(std::span(names.begin(), names.size()), key);
  }
  /// Points of the surface of some links: at a height (x, y), and in a plane of constant y (x, z), both leaned().
  std::vector<Vec2> level(double z, const Links& of) const;
  std::vector<Vec2> profile(double y, const Links& of, double lean_rad = 0) const;
  /// The same in a plane across an axis: (x, y) of the points whose z is `at` in the frame that X_FW takes them to.
  std::vector<Vec2> across(const Pose& X_FW, double at, const Links& of) const;
  /// Height of the lowest point [m]; infinite without a surface.
  double lowest(const Links& of) const;
  /// Hull of a level; mirrored about the median plane where asked. Throws InputError with `key` where there is none.
  std::vector<Vec2> hull(double z, const Links& of, bool mirrored, const char* key) const;
  /// The wrap between two heights of hulls, mirrored, at `heights` evenly spaced heights.
  Wrap wrap(double from, double to, const Links& of, const char* key, int heights = 65) const;

  /// Where a link's frame stands (the joint that carries it).
  const Vec3& origin(int link) const { return origin_[link]; }
  double medianY() const { return median_y_; }
  /// The skin as it stands, and how the shapes do.
  const TriangleMesh& skin() const { return skin_; }
  const std::vector<Placement>& placements() const { return placements_; }

 private:
  /// A level, or a profile where a lean is given.
  std::vector<Vec2> cut(double at, const Links& of, const double* lean) const;
  TriangleMesh skinOf(const Links& of) const;  ///< the part of the skin that belongs to some links

  const Human& human_;
  std::vector<Placement> placements_;
  std::vector<Vec3> origin_;
  TriangleMesh skin_;
  std::vector<int> segment_;  ///< empty: shapes
  double median_y_ = 0;
};

}  // namespace gambeson
