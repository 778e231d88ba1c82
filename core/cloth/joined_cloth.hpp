#pragma once
/// Cloths of different kinds as one: garments worn together.

#include <memory>
#include <vector>

#include "core/cloth/cloth.hpp"

namespace gambeson {

/// Points, patches, free points, samples, history and inner unknowns of all parts, in turn. No seam joins two parts.
class JoinedCloth : public Cloth {
 public:
  /// The first is innermost. One part or more.
  explicit JoinedCloth(std::vector<std::unique_ptr<const Cloth>> parts);
  JoinedCloth(const JoinedCloth&) = delete;
  JoinedCloth& operator=(const JoinedCloth&) = delete;
  ~JoinedCloth() override;

  const std::vector<Vec3>& rest() const override { return rest_; }
  const FreeMap& map() const override { return map_; }
  const std::vector<ClothPatch>& patches() const override { return patches_; }
  std::string pointName() const override { return "points"; }
  std::string kernels() const override;
  std::string describePoint(int point) const override;
  Vec2 placeOfDraft(int patch, Vec2 uv) const override;
  std::vector<Vec3> fromDraft(std::span<const Vec3> control) const override;
  int draftPoints() const override;

  Surface surface(std::span<const int> per_cell) const override;
  Bulges bulges(const Surface& surface, std::span<const int> per_cell) const override;
  SparseRows finer(int fineness, std::span<const int> per_cell) const override;
  PlaceMesh placeMesh(int per_cell) const override;
  Fabric fabricAt(int patch, Vec2 uv) const override;
  double cellAt(int patch, Vec2 uv) const override;
  std::vector<NetEdge> net() const override;

  std::vector<double> areas() const override;
  std::vector<double> masses() const override;
  std::vector<double> evenedMasses(double share) const override;
  SparseRows consistentMass() const override;
  SewnRows sewnRows() const override;

  using Cloth::force;
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const override;
  std::unique_ptr<ClothTangent> tangent() const override;
  bool damps() const override;
  void dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const override;

  std::size_t historySize() const override { return history_.back(); }
  void startHistory(std::span<double> history) const override;
  std::vector<HistoryPlace> historyPlaces() const override;
  std::size_t innerValues() const override { return values_.back(); }
  std::size_t innerRates() const override { return rates_.back(); }
  void startInner(std::span<double> value) const override;
  bool turnsInner() const override;
  void dropIdle(std::span<const double> value, std::span<double> rate) const override;
  void innerMasses(std::span<double> mass) const override;
  void advance(std::span<const double> value, std::span<const double> rate, double dt_s,
               std::span<double> out) const override;

  std::unique_ptr<StressView> stress() const override;
  PointState stateAt(const ClothState& state, int patch, Vec2 uv) const override;
  double bendAt(const ClothState& state, int patch, Vec2 uv) const override;
  std::vector<std::pair<int, Vec2>> lawPlaces() const override;
  void steepForce(const ClothState& state, const ClothForce& out, ClothWork& work, ForceTerms terms,
                  const StrainBox& within) const override;
  std::optional<StrainBox> lawStrains(const ClothState& state) const override;
  LawRange lawRange(const ClothState& state) const override;
  bool springsAtRest(double length_m) const override;

  StrainRows strainRows(Mobility mobility, LimitPoints points) const override;
  Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const override;

  const Mounting& mounting() const override { return *mounting_; }

  const std::vector<std::unique_ptr<const Cloth>>& parts() const { return parts_; }
  /// Which part a patch is of, and its number there.
  std::pair<std::size_t, int> partOf(int patch) const;
  int firstPatch(std::size_t part) const { return patch_[part]; }
  int firstPoint(std::size_t part) const { return point_[part]; }
  int firstFree(std::size_t part) const { return free_[part]; }
  int firstRate(std::size_t part) const { return static_cast<int>(rates_[part]); }
  /// What a part has of a state.
  ClothState stateOf(const ClothState& state, std::size_t part) const;

 private:
  std::vector<std::unique_ptr<const Cloth>> parts_;
  std::vector<int> patch_{0}, point_{0}, free_{0};  ///< first of each part, and the end
  std::vector<std::size_t> history_{0}, values_{0}, rates_{0};
  std::vector<Vec3> rest_;
  FreeMap map_;
  std::vector<ClothPatch> patches_;
  std::unique_ptr<const Mounting> mounting_;
};

}  // namespace gambeson
