#include "tryon/pattern/flat/standing_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "human/body/skin.hpp"

namespace gambeson {
namespace {

bool isOf(const StandingBody::Links& of, int link) { return std::find(of.begin(), of.end(), link) != of.end(); }

}  // namespace

StandingBody::StandingBody(const Human& human, const Posture& posture) : human_(human), form_(human, posture) {
  if (human.skin) {
    shapes_.push_back({form_.skin(), "skin"});
    placements_.emplace_back();
    return;
  }
  for (const BodyShape& s : human.shapes)
    shapes_.push_back({s.shape, human.skeleton.links[static_cast<std::size_t>(s.link)].name});
  placements_ = form_.placements();
}

int StandingBody::link(const std::string& name) const {
  const int found = human_.skeleton.link(name);
  if (found < 0) throw InputError({"", 0, "human"}, "has no link " + name + ", around which panels could be placed");
  return found;
}

StandingBody::Links StandingBody::links(std::initializer_list<const char*> names) const {
  Links out;
  for (const char* name : names) out.push_back(link(name));
  return out;
}

StandingBody::Links StandingBody::distalOf(const std::string& name) const {
  Links out;
  const int from = human_.skeleton.link(name);
  for (int l = 0; from >= 0 && l < static_cast<int>(human_.skeleton.links.size()); ++l)
    if (human_.skeleton.isDistal(l, from)) out.push_back(l);
  return out;
}

std::vector<Vec3> StandingBody::points(const Links& of) const {
  constexpr int kRings = 24, kAround = 48;
  std::vector<Vec3> out;
  if (human_.skin) {
    const std::vector<Vec3>& x = std::get<TriangleMesh>(shapes_[0].shape).vertices;
    for (std::size_t v = 0; v < x.size(); ++v)
      if (isOf(of, human_.skin->segment[v])) out.push_back(x[v]);
    return out;
  }
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (!isOf(of, human_.shapes[i].link)) continue;
    const auto* e = std::get_if<Ellipsoid>(&shapes_[i].shape);
    if (!e) {
      for (const Vec3& v : std::get<TriangleMesh>(shapes_[i].shape).vertices) out.push_back(placements_[i] * v);
      continue;
    }
    const Vec3& a = e->semi_axes;
    for (int r = 0; r <= kRings; ++r)
      for (int k = 0; k < kAround; ++k) {
        const double polar = std::numbers::pi * r / kRings, round = 2 * std::numbers::pi * k / kAround;
        out.push_back(placements_[i] * Vec3{a.x * std::sin(polar) * std::cos(round),
                                            a.y * std::sin(polar) * std::sin(round), a.z * std::cos(polar)});
      }
  }
  return out;
}

double StandingBody::lowest(const Links& of) const {
  double lowest = HUGE_VAL;
  for (const Vec3& x : points(of)) lowest = std::min(lowest, x.z);
  return lowest;
}

Posture withArmsAside(const Human& human, Posture posture, double shoulder_abduction_rad) {
  for (const char* side : {"_right", "_left"})
    if (const int shoulder = human.skeleton.joint(std::string("shoulder_abduction") + side); shoulder >= 0) {
      double& now = posture.q[static_cast<std::size_t>(shoulder)];
      now = std::max(now, shoulder_abduction_rad);
    }
  return posture;
}

}  // namespace gambeson
