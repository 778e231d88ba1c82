#include "core/cloth/triangles/triangle_stress.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/plane_stress.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {

TriangleStress::TriangleStress(const TriangleCloth& cloth)
    : cloth_(cloth), around_(static_cast<std::size_t>(cloth.points())) {
  for (std::size_t t = 0; t < cloth.triangles().size(); ++t)
    for (int point : cloth.triangles()[t]) around_[static_cast<std::size_t>(point)].push_back(static_cast<int>(t));
}

StressView::Sample TriangleStress::ofTriangle(const ClothState& state, int patch, int triangle,
                                              const More& more) const {
  const PointState s = cloth_.elements().stateOf(triangle, state);
  Vec2 extra{};
  if (more) extra = more(patch, {2.0 * (triangle - cloth_.firstTriangle(patch)) + 1.0 / 3, 1.0 / 3});
  return {cauchyStress(s.strain, s.n + Vec3{extra.x, extra.y, 0}), {s.strain.x, s.strain.y, 0.5 * s.strain.z}};
}

std::size_t TriangleStress::cells() const { return cloth_.triangles().size(); }

std::vector<StressView::Sample> TriangleStress::means(const ClothState& state, const More& more) const {
  std::vector<Sample> all(cloth_.triangles().size());
  for (int p = 0; p < static_cast<int>(cloth_.patches().size()); ++p) {
    const int end = cloth_.firstTriangle(p + 1);
    forAll(Each::much, cloth_.firstTriangle(p), end,
           [&](int t) { all[static_cast<std::size_t>(t)] = ofTriangle(state, p, t, more); });
  }
  return all;
}

StressView::Sample TriangleStress::shownAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                                           const More& more) const {
  const auto [triangle, weight] = cloth_.locate(patch, uv);
  const auto of = [&](int t) {
    return means.empty() ? ofTriangle(state, patch, t, more) : means[static_cast<std::size_t>(t)];
  };
  const auto corner =
      std::find_if(weight.begin(), weight.end(), [](double w) { return w > 1 - 1e-9; }) - weight.begin();
  if (corner == 3) return of(triangle);
  Sample sum;
  double area = 0;
  const int point = cloth_.triangles()[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(corner)];
  for (const int t : around_[static_cast<std::size_t>(point)])
    area += cloth_.elements().triangles()[static_cast<std::size_t>(t)].area_m2;
  for (const int t : around_[static_cast<std::size_t>(point)]) {
    const double part = cloth_.elements().triangles()[static_cast<std::size_t>(t)].area_m2 / area;
    const Sample s = of(t);
    addScaled(sum.stress, part, s.stress);
    addScaled(sum.strain, part, s.strain);
  }
  return sum;
}

PrincipalStress TriangleStress::at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                                   const More& more) const {
  const Sample s = shownAt(state, patch, uv, means, more);
  const auto stress = principalValues(s.stress), strain = principalValues(s.strain);
  return {stress[0], stress[1], strain[0], strain[1]};
}

PlaneTensor TriangleStress::strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const {
  return shownAt(state, patch, uv, means, {}).strain;
}

}  // namespace gambeson
