#pragma once
/// What all cloth on patches has in common, whatever its law: where its points are, which of them move freely, its
/// samples, places, masses, supports and files. Its points are the control points of a draft, or nodes made of them.

#include <memory>

#include "core/cloth/cloth.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/nodal_draft.hpp"

namespace gambeson {

class PatchCloth : public Cloth {
 public:
  PatchCloth(const PatchCloth&) = delete;
  PatchCloth& operator=(const PatchCloth&) = delete;
  ~PatchCloth() override;

  const Garment& garment() const { return garment_; }

  const std::vector<Vec3>& rest() const override { return rest_; }
  const FreeMap& map() const override { return map_; }
  const std::vector<ClothPatch>& patches() const override { return patches_; }
  std::string describePoint(int point) const override;
  Vec2 placeOfDraft(int, Vec2 uv) const override { return uv; }
  int draftPoints() const override;
  std::vector<Vec3> fromDraft(std::span<const Vec3> control) const override;

  Surface surface(std::span<const int> per_cell) const override;
  Bulges bulges(const Surface& surface, std::span<const int> per_cell) const override;
  SparseRows finer(int fineness, std::span<const int> per_cell) const override;
  PlaceMesh placeMesh(int per_cell) const override;
  Fabric fabricAt(int patch, Vec2 uv) const override;
  double cellAt(int patch, Vec2 uv) const override;
  std::vector<NetEdge> net() const override;
  std::vector<PatchLayout> geometry() const override;

  std::vector<double> areas() const override;
  std::vector<double> masses() const override;
  std::vector<double> evenedMasses(double share) const override;
  SparseRows consistentMass() const override;

  StrainRows strainRows(Mobility mobility, LimitPoints points) const override;
  Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const override;

  SewnRows sewnRows() const override;

  const Mounting& mounting() const override { return *mounting_; }

 protected:
  /// Throws InputError on bad geometry or seams.
  explicit PatchCloth(Garment garment);
  /// Its points are nodes, held together in position along all seams.
  explicit PatchCloth(const NodalDraft& draft);

 private:
  Garment garment_;
  SparseRows of_control_;  ///< of nodes; no rows: points are control points
  FreeMap map_;
  std::vector<Vec3> rest_;
  std::vector<ClothPatch> patches_;
  std::unique_ptr<const Mounting> mounting_;
};

}  // namespace gambeson
