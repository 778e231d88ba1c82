#pragma once
/// Cloth of point masses and springs as a cloth (Man 2006, sections 2.1.1.1 and 2.2): spring_net.hpp.

#include "core/cloth/patches/patch_cloth.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/springs/spring_net.hpp"
#include "core/math/instruction_sets.hpp"

namespace gambeson {

class SpringCloth : public PatchCloth {
 public:
  /// Between the nodes of a draft (nodalDraft). Throws InputError where it cannot be made of springs (springNet).
  explicit SpringCloth(const Garment& draft, const SpringNumbers& numbers = {})
      : SpringCloth(nodalDraft(draft), numbers) {}

  const SpringNet& springs() const { return springs_; }

  std::string pointName() const override { return "points"; }
  std::string kernels() const override { return kOneForAll; }

  using Cloth::force;
  /// Flexion springs are bending, the others the membrane.
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const override;
  std::unique_ptr<ClothTangent> tangent() const override;

  std::unique_ptr<StressView> stress() const override;
  PointState stateAt(const ClothState& state, int patch, Vec2 uv) const override;
  double bendAt(const ClothState& state, int patch, Vec2 uv) const override;
  std::vector<std::pair<int, Vec2>> lawPlaces() const override;
  /// Springs are without force at rest, whatever its shape.
  bool springsAtRest(double) const override { return false; }

  /// The cells around a place: one inside of a cell, up to four at a point.
  std::vector<int> cellsAt(int patch, Vec2 uv) const;
  /// Of a cell of a patch, from the middles of its sides; curvatures from second differences of the points around it.
  PointState stateOf(int patch, int cell, std::span<const Vec3> q) const;
  /// (k11, k22, 2 k12) there, that at rest not subtracted [1/m].
  Vec3 curvatureOf(int patch, int cell, std::span<const Vec3> q) const;

 private:
  class Place;

  SpringCloth(const NodalDraft& draft, const SpringNumbers& numbers);

  SpringNet springs_;
  SlotGather gather_;
};

}  // namespace gambeson
