#include "core/cloth/patches/cell_stress.hpp"

#include <utility>

#include "core/cloth/patches/bilinear.hpp"
#include "core/cloth/plane_stress.hpp"

namespace gambeson {

CellStress::CellStress(const PatchCloth& cloth, std::vector<int> first_cell, OfCell of_cell)
    : cloth_(cloth),
      first_cell_(std::move(first_cell)),
      of_cell_(std::move(of_cell)),
      middles_(cellMiddles(cloth.garment())) {
  for (const NurbsPatch& patch : cloth.garment().patches)
    for (int c = 0; c < cellCount(patch); ++c) {
      std::array<Vec3, 4> x;
      for (std::size_t k = 0; k < 4; ++k) x[k] = patch.points[static_cast<std::size_t>(cornersOf(patch, c)[k])];
      areas_m2_.push_back(0.5 * norm(cross(x[3] - x[0], x[2] - x[1])));
    }
}

std::vector<StressView::Sample> CellStress::means(const ClothState& state, const More& more) const {
  std::vector<Sample> all;
  for (std::size_t p = 0; p + 1 < first_cell_.size(); ++p)
    for (int c = first_cell_[p]; c < first_cell_[p + 1]; ++c)
      all.push_back(sampleOf(state, static_cast<int>(p), c, more));
  return all;
}

PrincipalStress CellStress::at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                               const More& more) const {
  const Sample s = shownAt(state, patch, uv, means, more);
  const auto stress = principalValues(s.stress), strain = principalValues(s.strain);
  return {stress[0], stress[1], strain[0], strain[1]};
}

PlaneTensor CellStress::strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const {
  return shownAt(state, patch, uv, means, {}).strain;
}

StressView::Sample CellStress::sampleOf(const ClothState& state, int patch, int cell, const More& more) const {
  const PointState s = of_cell_(state, patch, cell);
  Vec2 extra{};
  if (more) extra = more(patch, middles_[static_cast<std::size_t>(cell)].second);
  return {cauchyStress(s.strain, s.n + Vec3{extra.x, extra.y, 0}), {s.strain.x, s.strain.y, 0.5 * s.strain.z}};
}

StressView::Sample CellStress::shownAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                                       const More& more) const {
  Sample sum;
  double area = 0;
  std::vector<int> around = cellsAt(cloth_.garment().patches[static_cast<std::size_t>(patch)], uv);
  for (int& c : around) c += first_cell_[static_cast<std::size_t>(patch)];
  for (const int c : around) area += areas_m2_[static_cast<std::size_t>(c)];
  for (const int c : around) {
    const double part = areas_m2_[static_cast<std::size_t>(c)] / area;
    const Sample s = means.empty() ? sampleOf(state, patch, c, more) : means[static_cast<std::size_t>(c)];
    addScaled(sum.stress, part, s.stress);
    addScaled(sum.strain, part, s.strain);
  }
  return sum;
}

}  // namespace gambeson
