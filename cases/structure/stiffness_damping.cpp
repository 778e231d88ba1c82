#include "cases/structure/stiffness_damping.hpp"

#include "core/statics/structure_system.hpp"

namespace gambeson {

std::vector<double> stiffnessDamping(const Structure& s, const State& state, std::span<const Vec3> q) {
  BlockMatrix K = s.tangent->sparsity();
  ClothWork work;
  ForceTerms terms;
  terms.definite = s.cloth->turnsInner();
  s.tangent->assemble({q, state.inner, state.history}, work, K, terms);
  if (s.loads.follow() && !terms.definite)
    s.loads.addStiffness(q, programValues(s, state.time_s, ProgramEnds::constant), s.cloth->map(), K);
  std::vector<double> rates(&state.v.data()->x, &state.v.data()->x + 3 * state.v.size()), force(3ul * K.rows());
  rates.insert(rates.end(), state.inner_rate.begin(), state.inner_rate.end());
  rates.resize(force.size());
  multiply(K, rates, force);
  for (double& f : force) f *= s.rayleigh_stiffness_s;
  return force;
}

}  // namespace gambeson
