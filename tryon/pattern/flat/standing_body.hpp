#pragma once
/// A body as it stands, as its surface: what panels are placed around.

#include <initializer_list>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "human/body/body.hpp"
#include "human/motion/motion.hpp"
#include "tryon/pattern/form.hpp"

namespace gambeson {

class StandingBody {
 public:
  using Links = gambeson::Links;

  /// `human` outlives it and has a surface.
  StandingBody(const Human& human, const Posture& posture);

  const Human& human() const { return human_; }
  /// A link by its name; throws InputError (key "human") where there is none.
  int link(const std::string& name) const;
  Links links(std::initializer_list<const char*> names) const;
  /// The link and all that lies distal of it; empty where there is none of this name.
  Links distalOf(const std::string& name) const;
  /// Where a link's frame stands (the joint that carries it).
  const Vec3& origin(int link) const { return form_.origin(link); }
  double medianY() const { return form_.medianY(); }

  /// Points of the surface of some links: vertices, or 24 by 48 points of an ellipsoid.
  std::vector<Vec3> points(const Links& of) const;
  /// BodyForm::level.
  std::vector<Vec2> level(double z, const Links& of) const { return form_.level(z, of); }
  /// Height of the lowest of these points.
  double lowest(const Links& of) const;
  /// The whole surface, as shapes that stand: those of the links, or the skin as one mesh.
  const std::vector<Obstacle>& shapes() const { return shapes_; }
  const std::vector<Placement>& placements() const { return placements_; }

 private:
  const Human& human_;
  BodyForm form_;
  std::vector<Obstacle> shapes_;
  std::vector<Placement> placements_;
};

/// The posture with the arms at least this much from the sides, where the skeleton has shoulders.
Posture withArmsAside(const Human& human, Posture posture, double shoulder_abduction_rad);

}  // namespace gambeson
