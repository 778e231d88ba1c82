#pragma once
/// Stress and strain of cloth of degree 1 as pictures and tables show them: those of its cells; at a place the mean
/// over the cells around it, by their areas at rest.

#include <functional>
#include <vector>

#include "core/cloth/patches/patch_cloth.hpp"

namespace gambeson {

class CellStress : public StressView {
 public:
  /// What stands in a cell, counted over all patches.
  using OfCell = std::function<PointState(const ClothState& state, int patch, int cell)>;
  /// `first_cell`: of each patch, one more than there are patches. Lives no longer than its cloth.
  CellStress(const PatchCloth& cloth, std::vector<int> first_cell, OfCell of_cell);

  std::size_t cells() const override { return areas_m2_.size(); }
  std::vector<Sample> means(const ClothState& state, const More& more) const override;
  PrincipalStress at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                     const More& more) const override;
  PlaneTensor strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const override;

 private:
  Sample sampleOf(const ClothState& state, int patch, int cell, const More& more) const;
  Sample shownAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means, const More& more) const;

  const PatchCloth& cloth_;
  std::vector<int> first_cell_;
  OfCell of_cell_;
  std::vector<double> areas_m2_;
  std::vector<std::pair<int, Vec2>> middles_;
};

}  // namespace gambeson
