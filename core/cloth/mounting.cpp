#include "core/cloth/mounting.hpp"

#include <cmath>

#include "core/error.hpp"

namespace gambeson {

void checkSupport(const std::string& name, std::span<const Vec3> directions, const Prescribed& motion) {
  const auto reject = [&](const char* reason) { throw InputError({"", 0, name}, reason); };
  if (!(std::isfinite(norm(motion.displacement_m)))) reject("the prescribed displacement is not finite");
  if (motion.program < 0 && norm(motion.displacement_m) > 0)
    reject("a prescribed displacement needs a program that says when it acts");
  if (directions.empty()) reject("needs at least one direction");
  for (const Vec3& d : directions)
    if (!(std::abs(norm(d) - 1) <= 1e-6)) reject("directions must be unit vectors");
}

LinearConstraint supportEquation(const std::string& name, const Vec3& direction, const Prescribed& motion) {
  LinearConstraint c;
  c.name = name;
  c.amount_m = dot(direction, motion.displacement_m);
  if (c.amount_m != 0) c.program = motion.program;
  return c;
}

void checkFiniteLoad(const Vec3& v, const char* name) {
  if (!std::isfinite(v.x + v.y + v.z)) throw InputError({"", 0, name}, "must be finite");
}

std::vector<LinearConstraint> Mounting::turnEdge(const PatchEdge& edge, const Vec3&, int) const {
  throw InputError({"", 0, "turn of " + edgeName(edge)}, "this cloth has no directors; only a degenerated shell has");
}

}  // namespace gambeson
