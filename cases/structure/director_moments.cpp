#include "cases/structure/director_moments.hpp"

namespace gambeson {

std::vector<Vec3> directorMoments(const Structure& s, std::span<const double> pull, std::span<const double> programs) {
  if (!s.cloth->turnsInner()) return {};
  std::vector<double> load(s.cloth->innerRates());
  s.loads.addInner(programs, load);
  std::vector<Vec3> moments(load.size() / 3);
  for (std::size_t k = 0; k < load.size(); ++k) moments[k / 3][static_cast<int>(k % 3)] = pull[k] - load[k];
  return moments;
}

std::vector<Vec3> directorMoments(const Structure& s, const ClothState& state, std::span<const double> programs) {
  if (!s.cloth->turnsInner()) return {};
  std::vector<Vec3> f(state.q.size());
  std::vector<double> pull(s.cloth->innerRates());
  ClothWork work;
  s.cloth->force(state, {f, pull, {}, nullptr}, work);
  for (double& v : pull) v = -v;
  return directorMoments(s, pull, programs);
}

std::vector<Vec3> directorMoments(const Structure& s, const ClothState& state, std::span<const double> programs,
                                  std::span<const double> rate, std::span<const double> acceleration) {
  std::vector<Vec3> moments = directorMoments(s, state, programs);
  const double per_mass = s.rayleigh_mass_per_s + s.innerDrag();
  for (std::size_t k = 0; k < 3 * moments.size(); ++k)
    moments[k / 3][static_cast<int>(k % 3)] += s.inner_mass[k] * (acceleration[k] + per_mass * rate[k]);
  return moments;
}

std::set<int> directorsOn(const Cloth& cloth, std::span<const PatchEdge> edges) {
  std::set<int> directors;
  if (!cloth.turnsInner()) return directors;
  for (const PatchEdge& edge : edges)
    for (const LinearConstraint& held : cloth.mounting().clampEdge(edge))
      for (const auto& [rate, coefficient] : held.inner) directors.insert(rate / 3);
  return directors;
}

}  // namespace gambeson
