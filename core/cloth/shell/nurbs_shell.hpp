#pragma once
/// The NURBS Kirchhoff-Love sheet as a cloth.

#include <memory>

#include "core/cloth/cloth.hpp"
#include "core/cloth/shell/shell.hpp"

namespace gambeson {

struct ShellOptions {
  int gauss_extra = 0;  ///< points more than degree + 1 in each direction
  CellRule rule = CellRule::automatic;
  const KernelSet* kernels = nullptr;  ///< the widest where null
};

class NurbsShell : public Cloth {
 public:
  /// Throws InputError on bad geometry, seams, fields or fabric.
  explicit NurbsShell(const Garment& garment, const ShellOptions& options = {});
  NurbsShell(const NurbsShell&) = delete;
  NurbsShell& operator=(const NurbsShell&) = delete;
  ~NurbsShell() override;

  const Shell& elements() const { return shell_; }
  const Garment& garment() const { return shell_.garment(); }

  const std::vector<Vec3>& rest() const override { return rest_; }
  const FreeMap& map() const override { return map_; }
  const std::vector<ClothPatch>& patches() const override { return patches_; }
  std::string pointName() const override { return "control points"; }
  std::string kernels() const override { return shell_.kernels().name; }
  std::string describePoint(int point) const override;
  Vec2 placeOfDraft(int, Vec2 uv) const override { return uv; }
  int draftPoints() const override { return points(); }
  std::vector<Vec3> fromDraft(std::span<const Vec3> control) const override { return {control.begin(), control.end()}; }

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

  using Cloth::force;
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const override;
  std::unique_ptr<ClothTangent> tangent() const override;
  std::size_t historySize() const override { return shell_.memory().doubles(); }
  std::vector<HistoryPlace> historyPlaces() const override { return shell_.memory().places(); }

  std::unique_ptr<StressView> stress() const override;
  PointState stateAt(const ClothState& state, int patch, Vec2 uv) const override;
  double bendAt(const ClothState& state, int patch, Vec2 uv) const override;
  std::vector<std::pair<int, Vec2>> lawPlaces() const override;
  bool springsAtRest(double length_m) const override;

  StrainRows strainRows(Mobility mobility, LimitPoints points) const override;
  Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const override;

  const Mounting& mounting() const override { return *mounting_; }

 private:
  Shell shell_;
  FreeMap map_;
  std::vector<Vec3> rest_;
  std::vector<ClothPatch> patches_;
  std::unique_ptr<const Mounting> mounting_;
};

}  // namespace gambeson
