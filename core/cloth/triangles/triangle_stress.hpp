#pragma once
/// Stress and strain of triangles as pictures and tables show them: those of the triangles, at vertices their mean by
/// area over the triangles of the same patch.

#include <vector>

#include "core/cloth/stress.hpp"

namespace gambeson {

class TriangleCloth;

class TriangleStress : public StressView {
 public:
  explicit TriangleStress(const TriangleCloth& cloth);
  std::size_t cells() const override;
  std::vector<Sample> means(const ClothState& state, const More& more) const override;
  PrincipalStress at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                     const More& more) const override;
  PlaneTensor strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const override;

 private:
  Sample ofTriangle(const ClothState& state, int patch, int triangle, const More& more) const;
  Sample shownAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means, const More& more) const;

  const TriangleCloth& cloth_;
  std::vector<std::vector<int>> around_;  ///< triangles of each point
};

}  // namespace gambeson
