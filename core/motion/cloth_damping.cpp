#include "core/motion/cloth_damping.hpp"

namespace gambeson {

void addClothDamping(const Model& m, std::span<const Vec3> v, State& s, StepWork& w) {
  w.damping.clear();
  w.damping_power_W = 0;
  if (!m.cloth->damps()) return;
  const auto points = static_cast<std::size_t>(m.cloth->points());
  w.net_velocity.resize(points);
  w.f.resize(points);
  m.cloth->map().T.multiply<Vec3>(v, w.net_velocity);
  ClothEnergy energy;
  m.cloth->dampingForce({w.q, s.inner, {}, w.net_velocity}, {w.f, {}, {}, &energy}, w.cloth);
  w.damping_power_W = energy.power_W;
  w.damping.resize(s.a.size());
  m.cloth->map().Tt.multiply<Vec3>(w.f, w.damping);
  for (std::size_t i = 0; i < s.a.size(); ++i) s.a[i] += w.damping[i];
}

std::vector<Vec3> clothDamping(const Cloth& cloth, std::span<const Vec3> q, std::span<const Vec3> v) {
  if (!cloth.damps()) return {};
  std::vector<Vec3> all(q.size()), f(q.size()), free(v.size());
  cloth.map().T.multiply<Vec3>(v, all);
  ClothWork work;
  cloth.dampingForce({q, {}, {}, all}, {f, {}, {}, nullptr}, work);
  cloth.map().Tt.multiply<Vec3>(f, free);
  return free;
}

double clothDampingPower(const State& s, const StepWork& w) {
  double power = 0;
  for (std::size_t i = 0; i < w.damping.size(); ++i) power -= dot(w.damping[i], s.v[i]);
  return power;
}

}  // namespace gambeson
