#pragma once
/// The NURBS Kirchhoff-Love sheet as a cloth.

#include <memory>

#include "core/cloth/patches/patch_cloth.hpp"
#include "core/cloth/shell/shell.hpp"

namespace gambeson {

struct ShellOptions {
  int gauss_extra = 0;  ///< points more than degree + 1 in each direction
  CellRule rule = CellRule::automatic;
  const KernelSet* kernels = nullptr;  ///< the widest where null
};

class NurbsShell : public PatchCloth {
 public:
  /// Throws InputError on bad geometry, seams, fields or fabric.
  explicit NurbsShell(const Garment& garment, const ShellOptions& options = {});

  const Shell& elements() const { return shell_; }

  std::string pointName() const override { return "control points"; }
  std::string kernels() const override { return shell_.kernels().name; }

  using Cloth::force;
  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const override;
  std::unique_ptr<ClothTangent> tangent() const override;
  std::size_t historySize() const override { return shell_.memory().doubles(); }
  std::vector<HistoryPlace> historyPlaces() const override { return shell_.memory().places(); }

  std::unique_ptr<StressView> stress() const override;
  PointState stateAt(const ClothState& state, int patch, Vec2 uv) const override;
  double bendAt(const ClothState& state, int patch, Vec2 uv) const override;
  std::vector<std::pair<int, Vec2>> lawPlaces() const override;
  void steepForce(const ClothState& state, const ClothForce& out, ClothWork& work, ForceTerms terms,
                  const StrainBox& within) const override {
    terms.steepest = true;
    shell_.force(state, out, work, terms, within);
  }
  std::optional<StrainBox> lawStrains(const ClothState& state) const override { return shell_.lawStrains(state); }
  LawRange lawRange(const ClothState& state) const override { return shell_.lawRange(state); }
  bool springsAtRest(double length_m) const override;

 private:
  Shell shell_;
};

}  // namespace gambeson
